#pragma once
#include "experiments/results/verdicts/effects/time_effects.h"
#include "experiments/results/verdicts/summary.h"

#include <filesystem>
#include <nlohmann/json.hpp>

/// The tables of a results folder that studies and their points are compared by.
struct StudyResults {
    nlohmann::json manifest;
    std::vector<MetricSummary> errors;        ///< summary.csv
    std::vector<ResultRow> seeds;             ///< results.csv
    std::vector<TimeSummary> times;           ///< time_summary.csv
    std::vector<TimeRow> rounds;              ///< times.csv
    std::vector<EffectRow> effects;           ///< effects.csv
    std::vector<TimeEffectRow> time_effects;  ///< time_effects.csv
    std::vector<CostRow> costs;               ///< costs.csv; empty where none were counted
    std::vector<EstimateRow> estimates;       ///< estimates.csv; empty where no GPU's times were estimated
};

/// Fails with Error, which names the member, where a manifest has another kind of value than those who read it expect.
void require_manifest(const nlohmann::json& manifest, const std::filesystem::path& file);

/// Fails with Error on what is no results folder, or one of another version or half of one (require_evaluation()).
StudyResults read_study_results(const std::filesystem::path& folder);
