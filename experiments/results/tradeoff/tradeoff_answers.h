#pragma once
#include "experiments/results/tradeoff/between_points.h"

/// The content of answers.md: sentences and tables in Markdown. `costs` (ascending) and `factors` (descending) are the
/// question.
std::string tradeoff_answers(const StudyResults& tables, const PrimaryComparisons& error, const Tradeoff& found,
                             const BetweenPoints& between, const std::vector<double>& costs,
                             const std::vector<double>& factors);

/// The commits of the programs that made a study's cells: "abc1234 and def5678 with changes".
std::string commits_of(const nlohmann::json& manifest);
