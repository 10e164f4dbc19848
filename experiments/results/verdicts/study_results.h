#pragma once
#include "experiments/results/verdicts/effects/over_scenes.h"
#include "experiments/results/verdicts/effects/time_effects.h"
#include "experiments/results/verdicts/summary.h"

#include <filesystem>
#include <nlohmann/json.hpp>

/// A results folder (experiments/docs/results_folder.md): manifest and tables, without parameters.csv. The reference's
/// noise is in no table: it exists only while a study runs.
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

/// Writes all tables, and removes tables of an earlier version of the study that this one lacks.
void write_tables(const std::filesystem::path& folder, const StudyResults& study);

enum class Runs { left_out, read };  ///< tables with TableUse::of_runs

/// Reads a results folder. Fails with Error if it is none, or if it lacks a table or column, as folders of unfinished
/// runs and of other versions of ssrlab do. The message then says what to run. No verdict is thus taken without its
/// columns.
StudyResults read_study_results(const std::filesystem::path& folder, Runs runs = Runs::read);
