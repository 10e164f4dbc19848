#pragma once
#include "experiments/results/verdicts/effects/over_scenes.h"
#include "experiments/results/verdicts/effects/time_effects.h"
#include "experiments/results/verdicts/summary.h"

#include <filesystem>
#include <nlohmann/json.hpp>

/// A results folder (experiments/RESULTS.md): its manifest and its tables, but for parameters.csv. The reference's
/// noise is in no table: it is there while a study runs.
struct StudyResults : MeasuredRows {
    nlohmann::json manifest = nlohmann::json::object();
    std::vector<EffectRow> effects = {};
    std::vector<TimeEffectRow> time_effects = {};
    std::vector<MetricSummary> summary = {};
    std::vector<OverScenesRow> over_scenes = {};
    std::vector<TimeSummary> time_summary = {};

    static constexpr auto tables() {
        using enum TableUse;
        return std::tuple(
            Table{"results", &MeasuredRows::results, of_runs}, Table{"splits", &MeasuredRows::splits, always},
            Table{"effects", &StudyResults::effects, always},
            Table{"time_effects", &StudyResults::time_effects, always}, Table{"times", &MeasuredRows::times, of_runs},
            Table{"summary", &StudyResults::summary, always}, Table{"over_scenes", &StudyResults::over_scenes, always},
            Table{"time_summary", &StudyResults::time_summary, always}, Table{"hits", &MeasuredRows::hits, if_any},
            Table{"costs", &MeasuredRows::costs, if_any}, Table{"compiled", &MeasuredRows::compiled, if_any},
            Table{"estimates", &MeasuredRows::estimates, if_any});
    }
};

/// Calls `use(table)` for each of StudyResults::tables().
template <class Use>
void for_each_table(Use use) {
    std::apply([&](const auto&... table) { (use(table), ...); }, StudyResults::tables());
}

/// Writes all tables, and removes those of an earlier version of the study that it lacks.
void write_tables(const std::filesystem::path& folder, const StudyResults& study);

enum class Runs { left_out, read };  ///< tables with TableUse::of_runs

/// Fails with Error on what is no results folder; with what to run where it lacks a table or a column, as half of one
/// and one of another version of ssrlab do, so that no verdict is taken from columns that are missing.
StudyResults read_study_results(const std::filesystem::path& folder, Runs runs = Runs::read);
