#pragma once
#include "core/gpu/device.h"
#include "core/gpu/passes/clock.h"
#include "experiments/results/cells/cell_store.h"
#include "experiments/results/cells/provenance.h"
#include "experiments/study/plan/cell_selection.h"
#include "experiments/study/progress.h"
#include "experiments/study/run.h"
#include "experiments/study/spent_time.h"
#include "experiments/study/workload.h"

/// SpentTime's name for compiling all points' shaders before the first cell.
inline constexpr const char* compiling = "compiling";

/// A run of at most so many shots says each point's result and each shot's answer, which fit a screen or two; of more,
/// it says one line for each shot, and the report has the answers.
inline constexpr size_t most_told_shots = 10;

/// The kind of a cell in Workload: one kind for a point and image size in all shots.
inline std::string kind_of_work(const PlannedCell& cell) {
    const std::string size = std::to_string(cell.pixels);
    return cell.technique ? cell.technique->technique + " " + cell.technique->point + " " + size : size;
}

/// The state of a running study. `config` and `settings` must outlive it.
struct StudySession {
    StudySession(const Config& config, const RunSettings& settings)
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
    nlohmann::json maker;  ///< maker of cells, see provenance.h
    StudyPlan plan;
    Workload work;
    SpentTime spent;
    std::optional<ClockProof> clock;  ///< made when first needed
    std::vector<Cell> finished;       ///< in the order of the plan
    size_t made = 0;                  ///< cells that this run made
    bool is_rehearsed = false;

    void report(double share, const std::string& what) {
        work.update(share);
        progress.update(work.share_done(), what);
    }
};
