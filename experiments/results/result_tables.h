#pragma once
#include "experiments/results/stability/stability_results.h"
#include "experiments/results/verdicts/effects/effects.h"
#include "experiments/results/verdicts/effects/over_scenes.h"
#include "experiments/results/verdicts/effects/time_effects.h"
#include "experiments/results/verdicts/study_points.h"
#include "experiments/results/verdicts/summary.h"

#include <nlohmann/json.hpp>

/// The tables of a results folder (experiments/RESULTS.md).
struct ResultTables {
    std::vector<MetricSummary> errors;
    std::vector<SplitRow> splits;
    std::vector<HitRow> hits;
    std::vector<CostRow> costs;
    std::vector<CompiledRow> compiled;
    std::vector<EstimateRow> estimates;
    std::vector<EffectRow> effects;
    std::vector<TimeEffectRow> time_effects;
    std::vector<TimeSummary> times;
    std::vector<OverScenesRow> over_scenes = {};
    StabilityResults stability;  ///< empty where `ssrlab stability` did not write into the folder
};

/// summary.csv, over_scenes.csv and time_summary.csv must be there, as this version writes them (require_evaluation());
/// other tables that are not are empty. `manifest` is the folder's.
ResultTables read_result_tables(const std::filesystem::path& folder, const nlohmann::json& manifest);
