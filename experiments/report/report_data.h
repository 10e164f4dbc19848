#pragma once
#include "experiments/results/stability/stability_results.h"
#include "experiments/results/verdicts/study_results.h"

#include <nlohmann/json.hpp>

/// The data of the page's scripts (page/study/data.js): tables as arrays, with texts as indices into `texts`, since
/// texts repeat. Single changes have only the rows that represent a shot, not each frame.
nlohmann::json report_data(const StudyResults& tables, const StabilityResults& stability,
                           const PointSet& single_changes);
