#pragma once
#include "experiments/results/files/comparisons.h"
#include "experiments/results/verdicts/study_results.h"

/// Decides what a study's numbers say, once for report, tables, figures and commands: of its manifest and measured rows
/// makes the errors with their intervals and standings, the errors over scenes, the times, and the effects on both. Of
/// points that the manifest does not name it is taken that they depend on seeds and that runs repeat them.
void evaluate(StudyResults& study, const std::vector<ComparedPoint>& compared, const PrimaryComparisons& primary);
