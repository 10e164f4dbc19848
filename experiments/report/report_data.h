#pragma once
#include "experiments/results/stability/stability_results.h"
#include "experiments/results/verdicts/study_results.h"

#include <nlohmann/json.hpp>

/// What the page's scripts read (page/study/data.js): tables as arrays, with texts as indices into `texts`, since few
/// texts are repeated many times. Of the single changes only what represents a shot, not each of its frames.
nlohmann::json report_data(const StudyResults& tables, const StabilityResults& stability,
                           const PointSet& single_changes);
