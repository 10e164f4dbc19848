#pragma once
#include "experiments/results/verdicts/judgement.h"

#include <vector>

/// What `ssrlab judge` decides of measured rows: the primary error of each shot and, of sequences, flicker, ghosts
/// and visibility (judged_sequences.h), together. Fails with Error as evidence_of_errors() does.
Judgement judge_rows(const MeasuredRows& rows, const std::vector<ComparedPoint>& compared,
                     const PointSet& not_repeatable, const PrimaryComparisons& primary, const PointName& point,
                     const PointName& against, const JudgeLimits& limits);
