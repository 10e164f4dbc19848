#pragma once
#include "experiments/results/files/comparisons.h"
#include "experiments/results/verdicts/study_results.h"

/// Evaluates a study's manifest and measured rows, once for report, tables, figures and commands: errors with intervals
/// and standings, errors over scenes, times, and effects on both. Points that the manifest does not name count as
/// depending on seeds and repeatable.
void evaluate(StudyResults& study, const std::vector<ComparedPoint>& compared, const PrimaryComparisons& primary);
