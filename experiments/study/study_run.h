#pragma once
#include "core/gpu/clock.h"
#include "core/gpu/device.h"
#include "experiments/measuring/workload.h"
#include "experiments/results/provenance.h"
#include "experiments/study/folder/cell_store.h"
#include "experiments/study/plan/study_plan.h"
#include "experiments/study/progress.h"
#include "experiments/study/run.h"
#include "experiments/study/spent_time.h"

/// What SpentTime calls the compilation of all points' shaders before the first cell.
inline constexpr const char* compiling = "compiling";

/// A study on its way: all that it needs. `config` and `settings` must outlive it.
struct StudyRun {
    StudyRun(const Config& config, const RunSettings& settings)
        : config(config),
          settings(settings),
          device(settings.device),
          cells(settings.out, [this](const std::string& text) { progress.say(text); }),
          maker(maker_of_cells(device)) {}

    const Config& config;
    const RunSettings& settings;
    Progress progress{1.0};
    Device device;
    CellStore cells;
    nlohmann::json maker;  ///< of cells, see provenance.h
    StudyPlan plan;
    Workload work;
    SpentTime spent;
    std::optional<ClockProof> clock;  ///< made when first needed
    std::vector<Cell> finished;       ///< in the order of the plan
    size_t made = 0;                  ///< cells that were not found done
    bool is_rehearsed = false;

    void report(double share, const std::string& what) {
        work.update(share);
        progress.update(work.share_done(), what);
    }
};

/// The cells of a shot that are asked for, into study.finished. What was done before is loaded; what other processes
/// are at is left to the end, and taken over from them. Nothing of the shot itself is loaded if all is done.
void run_shot(StudyRun& study, const PlannedShot& shot, const CellSelection& selection);
