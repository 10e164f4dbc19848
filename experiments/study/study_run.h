#pragma once
#include "core/gpu/clock.h"
#include "core/gpu/device.h"
#include "experiments/measuring/workload.h"
#include "experiments/study/cell_store.h"
#include "experiments/study/progress.h"
#include "experiments/study/run.h"
#include "experiments/study/shot_truth.h"

#include <chrono>

/// A study on its way: all that it needs.
struct StudyRun {
    const Config& config;
    const RunSettings& settings;
    Device& device;
    CellStore cells;
    Progress& progress;
    Workload work;
    std::string code;
    nlohmann::json maker;  ///< of cells, see provenance.h
    nlohmann::json manifest;
    nlohmann::json manifest_before;   ///< what the folder held when the run began; null if nothing
    std::optional<ClockProof> clock;  ///< made when first needed
    std::vector<Cell> finished;
    std::chrono::steady_clock::time_point report_made = {};  ///< when it was last done ...
    std::chrono::steady_clock::duration report_took = {};    ///< ... and how long that took

    void report(double share, const std::string& what) {
        work.update(share);
        progress.update(work.share_done(), what);
    }
};

/// A shot on its way: everything that its cells need.
struct ShotRun {
    const Shot& shot;
    FrameSource& source;
    FrameStore store;
    ShotTruth truth = {};
    nlohmann::json reference_entries = nlohmann::json::object();  ///< of the manifest's entry of the shot
    std::map<unsigned, std::vector<nlohmann::json>> reference_images = {};  ///< by the frame whose reference they are
};

/// All variants, points and seeds of a shot, then their times, into study.finished. What was done before is loaded;
/// what other processes are at is left to the end, and taken over from them.
void run_cells(StudyRun& study, ShotRun& run);
