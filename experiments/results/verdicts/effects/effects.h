#pragma once
#include "experiments/results/cells/cell.h"
#include "experiments/results/files/comparisons.h"
#include "experiments/results/verdicts/interval.h"
#include "metrics/statistics/estimates.h"

#include <functional>
#include <set>
#include <span>

/// The effect of a point on one error relative to a baseline: on the error, its squared bias or its variance.
struct EffectRow {
    std::string shot, frame, technique, point;
    std::string against;  ///< baseline_name, or "estimator=a": the only value that differs
    std::string against_technique, against_point, target, metric, formula, mask;
    size_t seeds = 0;                    ///< common seeds; a point that does not depend on seeds has all
    std::optional<double> ratio;         ///< mean error of the point / of the baseline; none if one is not above 0
    std::optional<double> low, high, p;  ///< 95 % interval; two-sided p of "the ratio is 1", see jackknifed_ratio()
    std::string interval;                ///< what the interval includes, or why there is none (interval.h)
    std::string family;                  ///< "primary" or "exploratory", see set_verdicts()
    std::optional<double> p_holm;        ///< p, adjusted for the effect's family
    std::optional<double> low_holm, high_holm;  ///< adjusted interval: excludes 1 where p_holm is below 0.05
    std::optional<double> p_equivalent;         ///< of "the ratio is not within the margin", RatioEstimate::p_beyond()
    std::optional<double> p_equivalent_holm;    ///< p_equivalent, adjusted for the effect's family
    std::string verdict;                        ///< see set_verdicts(); empty without a p
    RatioEstimate estimate{};                   ///< source of all these numbers; no column

    COLUMNS(EffectRow, shot, frame, technique, point, against, against_technique, against_point, target, metric,
            formula, mask, seeds, ratio, low, high, interval, p, family, p_holm, low_holm, high_holm, p_equivalent,
            p_equivalent_holm, verdict)
};

/// (technique, point)
using PointSet = std::set<PointName>;

/// All comparisons_of() `compared`, by errors for which less is better, over common seeds (jackknifed_ratio()). The
/// ratio is that of mean errors: a mean of the seeds' ratios would hide what a few seeds with large errors cost. Only
/// rows that represent their shot count.
///
/// Intervals include the scatter over seeds. Where `noise` has both points they include what their common reference's
/// noise leaves of the ratio, and how far it may have moved uncorrected errors (extrapolated_scatter()). No interval
/// and no p exist for a single seed of a point that depends on it, nor if a point is in `not_repeatable`: seeds do not
/// share such a point's chance, and another run would give another ratio.
std::vector<EffectRow> paired_effects(std::span<const ResultRow> rows, const std::vector<ComparedPoint>& compared,
                                      const PointSet& not_repeatable = {}, std::span<const ReferenceNoise> noise = {});

/// The effect of `technique` `point` on one error of `against_technique` `against_point`, for any two points, as in
/// paired_effects(). `asked` names both, with shot, target, metric and mask. None where either has no such error.
using PairedErrors = std::function<std::optional<EffectRow>(const EffectRow& asked)>;

/// The result refers to `rows` and `noise`, which must outlive it.
PairedErrors paired_errors(std::span<const ResultRow> rows, const std::vector<ComparedPoint>& compared,
                           const PointSet& not_repeatable = {}, std::span<const ReferenceNoise> noise = {});

/// Effects on squared bias and on variance, of each shot's last frame: whether a point wins by the one or the other.
/// From all pairs of the common seeds (two or more); intervals need three seeds.
std::vector<EffectRow> split_effects(std::span<const SplitRow> rows, const std::vector<ComparedPoint>& compared,
                                     const PointSet& not_repeatable = {});

/// EffectRow::verdict.
namespace verdict {
inline constexpr const char* less = "less";
inline constexpr const char* more = "more";
inline constexpr const char* equivalent = "equivalent";  ///< neither, and certainly within the margin
inline constexpr const char* undecided = "undecided";    ///< chance may have made the difference, or hidden one
inline constexpr const char* equal = "equal";            ///< equal to the last digit (pairs.h)
}  // namespace verdict

/// p-values of a pair: of "both are alike", and of "they are further apart than the margin".
struct PairP {
    double different = 1, beyond = 1;
};

/// The verdict by adjusted p-values.
inline const char* verdict_of(const PairP& p, double ratio) {
    return p.different < significance ? (ratio < 1 ? verdict::less : verdict::more)
           : p.beyond < significance  ? verdict::equivalent
                                      : verdict::undecided;
}

/// The adjusted p-values of a comparison that another family decides; nullopt for all others.
using DecidedPair = std::function<std::optional<PairP>(const EffectRow&)>;

/// Decides `verdict`, at 0.05, of all effects with a p whose interval includes all that is random. Others have none,
/// for example where the reference's noise is unknown.
///
/// The effects on one error (target, metric, mask), of all points and shots, are a family. Their p-values are adjusted
/// together (holm_adjusted()), as some of many comparisons come out small by chance. `low_holm` and `high_holm` are
/// intervals at the level of the verdict: 0.05 / the factor that adjusted p. The `primary` family is what the study was
/// made to compare; in `exploratory` families a significant effect is so among the effects on that error alone. Where
/// `decided` also knows a pair (decided_by_standings()), the larger p counts, so that a pair has one verdict.
void set_verdicts(std::span<EffectRow> effects, const PrimaryComparisons& primary, const DecidedPair& decided = {});
