#pragma once
#include "experiments/results/stability/stability_results.h"
#include "experiments/results/verdicts/study_results.h"

#include <nlohmann/json.hpp>

/// The data of the page's scripts (page/study/data.js): tables column by column, a column of equal values as one of
/// them, with texts as indices into `texts`, since texts repeat. Single changes have only the rows that represent a
/// shot, not each frame. Effects between techniques, and columns that no script reads, are left out.
nlohmann::json report_data(const StudyResults& tables, const StabilityResults& stability,
                           const PointSet& single_changes);
