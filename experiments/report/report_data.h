#pragma once
#include "experiments/evaluation/effects/effects.h"
#include "experiments/evaluation/effects/over_scenes.h"
#include "experiments/evaluation/effects/time_effects.h"
#include "experiments/evaluation/study_points.h"
#include "experiments/evaluation/summary.h"
#include "experiments/stability/stability_report.h"

#include <nlohmann/json.hpp>

/// The tables of a results folder (experiments/RESULTS.md).
struct ReportTables {
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
    StabilityTables stability;  ///< empty where `ssrlab stability` did not write into the folder
};

/// summary.csv, over_scenes.csv and time_summary.csv must be there, as this version writes them (require_evaluation());
/// other tables that are not are empty. `manifest` is the folder's.
ReportTables read_report_tables(const std::filesystem::path& folder, const nlohmann::json& manifest);

/// What the page's scripts read (page/data.js): tables as arrays, with texts as indices into `texts`, since few texts
/// are repeated many times. Of the single changes only what represents a shot, not each of its frames.
nlohmann::json report_data(const ReportTables& tables, const PointSet& single_changes);
