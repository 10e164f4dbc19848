#pragma once
#include "experiments/results/verdicts/judgement.h"

#include <span>
#include <vector>

// What is judged of sequences beside their error.

/// A share of the earlier image below this counts as no ghost (ghost_length has the same limit).
inline constexpr double visible_ghost = 0.05;

/// Two videos that differ by less JOD than this count as equally good: 53 % of observers would prefer the better one,
/// where 50 % choose by chance (normal distribution, 75 % at 1 JOD).
inline constexpr double visible_jod = 0.1;

/// The evidence on flicker: the ratio of frame_difference, which is the squared change between frames that the truth
/// does not have. Limits are those of errors. A shot where neither side flickers at all has none. A ratio without an
/// interval stays undecided, and the evidence says why. `rows`: of `effects`.
std::vector<Evidence> evidence_of_flicker(std::span<const EffectRow> effects, std::span<const ResultRow> rows,
                                          const PrimaryComparisons& primary, const PointName& point,
                                          const PointName& against, const JudgeLimits& limits);

/// The evidence on ghosts: ghost_share less that of the earlier frames, b. A tolerance R allows (R - 1) max(|b|,
/// visible_ghost) more. Equivalent shares differ by less than visible_ghost, or than the tolerance allows if that is
/// more. Shares below 0 are no ghosts: a rise to 0 is not worse, and a fall from 0 is not better. Student's t over
/// common seeds, with what the reference's `noise` leaves of the difference. Shots where the truth does not visibly
/// change have none.
std::vector<Evidence> evidence_of_ghosts(std::span<const ResultRow> rows, std::span<const ReferenceNoise> noise,
                                         const std::string& mask, const PointName& point, const PointName& against,
                                         const JudgeLimits& limits);

/// The evidence on visibility: 10 less cvvdp_0_5_6_video, which is the distance in JOD from the truth, less that of the
/// earlier frames. As evidence_of_ghosts(), with visible_jod in place of visible_ghost. Shots whose truth is too noisy
/// for an interval (most_noise_of_jod) have none.
std::vector<Evidence> evidence_of_visibility(std::span<const ResultRow> rows, std::span<const ReferenceNoise> noise,
                                             const PointName& point, const PointName& against,
                                             const JudgeLimits& limits);
