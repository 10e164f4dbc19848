#pragma once
#include "experiments/results/cells/study_rows.h"
#include "experiments/results/files/comparisons.h"

#include <filesystem>
#include <nlohmann/json.hpp>

/// Writes what a results folder's numbers say, decided once for report, tables, figures and commands: summary.csv
/// (means, intervals, standings), over_scenes.csv, time_summary.csv, effects.csv and time_effects.csv. `manifest` is
/// the folder's; of points that it does not name it is taken that they depend on seeds and that runs repeat them.
void write_evaluation(const std::filesystem::path& folder, const StudyRows& rows, const nlohmann::json& manifest,
                      const std::vector<ComparedPoint>& compared, const PrimaryComparisons& primary);

/// Fails with what to run where the folder lacks these files or another version of ssrlab wrote them, so that no
/// verdict is taken from columns that are missing. `manifest` says which version it was.
void require_evaluation(const std::filesystem::path& folder, const nlohmann::json& manifest);
