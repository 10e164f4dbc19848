#pragma once
#include "experiments/results/verdicts/effects/effects.h"
#include "experiments/results/verdicts/effects/over_scenes.h"

#include <algorithm>
#include <span>
#include <string>
#include <vector>

/// Whether a renderer's frames are worse than its earlier frames: the verdict that fails a build.
namespace judgement {
inline constexpr const char* better = "better";
inline constexpr const char* worse = "worse";
inline constexpr const char* equivalent = "equivalent";  ///< neither, and certainly within the margin or tolerance
inline constexpr const char* undecided = "undecided";
inline constexpr const char* identical = "identical";  ///< the same bytes, so nothing is measured
}  // namespace judgement

/// Significance of each verdict over all views: builds are judged daily, and each false alarm costs a morning.
inline constexpr double judge_significance = 0.01;

/// What can get worse.
namespace judged_number {
inline constexpr const char* error = "error";            ///< the primary error of each view
inline constexpr const char* flicker = "flicker";        ///< of sequences, see judged_sequences.h
inline constexpr const char* ghosts = "ghosts";          ///< likewise
inline constexpr const char* visibility = "visibility";  ///< of differences from the truth, likewise
}  // namespace judged_number

/// What the measurement says of one number of one shot, before anything is decided.
struct Evidence {
    std::string shot, what;                    ///< judged_number::
    double change = 1, low = 1, high = 1;      ///< number / that of the earlier frames, with its 95 % interval;
                                               ///< ghosts, visibility: share or JOD less that of those
    double no_change = 1;                      ///< 1; ghosts, visibility: 0
    double p_different = 1, p_equivalent = 1;  ///< of "not worse by the tolerance, nor better"; of "not equivalent"
    double detectable = 1;                     ///< the change that 95 % of such comparisons alone would call worse
    double of_light = 1;           ///< by this factor the noise of the light that frames read widens the interval
    std::string no_interval = {};  ///< why `low`, `high` and `detectable` are not known; else empty
};

struct JudgedView : Evidence {
    double p_holm = 1;    ///< p_different, adjusted for all that is judged together
    std::string verdict;  ///< judgement::
};

struct Judgement {
    std::vector<JudgedView> views;
    std::string verdict;  ///< worse if any view is, else better if any is, else equivalent if all are, else undecided
};

/// How much worse frames may be.
struct JudgeLimits {
    double worse_by = 1;                          ///< tolerance: up to this ratio, 1 or more, nothing is worse
    double margin = PrimaryComparisons().margin;  ///< of equivalence, without a tolerance above it

    /// The largest ratio that counts as equivalent.
    double most_equivalent() const { return std::max(worse_by, 1 + margin); }
};

/// The evidence on the ratio of one error. `row` must have an interval. Its p_equivalent is of `margin_of_row`; with
/// other limits than this and a tolerance of 1 it must have its `estimate`, which tables lack.
Evidence evidence_of_ratio(const EffectRow& row, const char* what, const JudgeLimits& limits, double margin_of_row);

/// The evidence on the primary error of `point` / that of `against`: in each shot the mean over frames, or the only
/// frame. Worse is a ratio above `limits.worse_by`, better one below 1, equivalent one between 1 / m and m =
/// most_equivalent(). Fails with Error, which says why, if a shot's effect has no interval of all that is random.
std::vector<Evidence> evidence_of_errors(std::span<const EffectRow> effects, const PrimaryComparisons& primary,
                                         const PointName& point, const PointName& against, const JudgeLimits& limits);

/// Decides all evidence together, by Holm's adjustment at judge_significance: here alone.
Judgement judge(const std::vector<Evidence>& evidence);

/// judge() of the errors without a tolerance.
Judgement judge_effects(std::span<const EffectRow> effects, const PrimaryComparisons& primary, const PointName& point,
                        const PointName& against);

/// Whether both points have equal values, to the last digit, of every measured seed, shot, frame, target, metric and
/// mask. Their frames then count as identical.
bool measure_alike(std::span<const ResultRow> rows, const PointName& point, const PointName& against);
