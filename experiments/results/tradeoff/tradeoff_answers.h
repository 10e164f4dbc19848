#pragma once
#include "experiments/results/tradeoff/between_points.h"

/// What `ssrlab tradeoff` found, as sentences and tables in Markdown: answers.md. `costs`, in ascending order, and
/// `factors`, in descending order: what was asked for.
std::string tradeoff_answers(const StudyResults& tables, const PrimaryComparisons& error, const Tradeoff& found,
                             const BetweenPoints& between, const std::vector<double>& costs,
                             const std::vector<double>& factors);
