#pragma once
#include "experiments/results/cells/cell.h"
#include "experiments/results/files/comparisons.h"
#include "experiments/results/verdicts/interval.h"
#include "metrics/statistics/estimates.h"

#include <functional>
#include <set>
#include <span>

/// What a point changes about one error of another, its baseline, or about its squared bias or its variance.
struct EffectRow {
    std::string shot, frame, technique, point;
    std::string against;  ///< baseline_name, or "estimator=a": the point that differs in this value alone
    std::string against_technique, against_point, target, metric, formula, mask;
    size_t seeds = 0;  ///< that both were run with; a point that does not depend on seeds has all
    std::optional<double>
        ratio;  ///< mean error of the point / of the baseline, over the seeds; none if one is not above 0
    std::optional<double> low, high, p;  ///< 95 % interval; two-sided p of "the ratio is 1", see jackknifed_ratio()
    std::string interval;                ///< what the interval holds, or why there is none (interval.h)
    std::string family;                  ///< "primary" or "exploratory", see set_verdicts()
    std::optional<double> p_holm;        ///< p adjusted for its family, see set_verdicts()
    std::optional<double> low_holm, high_holm;  ///< interval that leaves out 1 where p_holm is below 0.05
    std::optional<double> p_equivalent;         ///< of "the ratio is not within the margin", RatioEstimate::p_beyond()
    std::optional<double> p_equivalent_holm;    ///< adjusted for its family
    std::string verdict;                        ///< see set_verdicts(); empty without a p
    RatioEstimate estimate{};                   ///< what all of these are made of; no column

    COLUMNS(EffectRow, shot, frame, technique, point, against, against_technique, against_point, target, metric,
            formula, mask, seeds, ratio, low, high, interval, p, family, p_holm, low_holm, high_holm, p_equivalent,
            p_equivalent_holm, verdict)
};

/// (technique, point)
using PointSet = std::set<PointName>;

/// All comparisons_of() `compared` by errors for which less is better, over the seeds that both have
/// (jackknifed_ratio()): the ratio of the mean errors, since a mean of the seeds' ratios would hide what few seeds with
/// large errors cost. Only rows that speak
/// for their shot count.
///
/// Intervals hold the scatter over the seeds and, where `noise` has both points, what the noise of their common
/// reference leaves of the ratio, and how far it may have moved that of errors which hold it (extrapolated_scatter()).
/// No interval and no p are given for a single seed of a point that depends on it, nor
/// if one of both is in `not_repeatable`: seeds do not share what such points add by chance, and another run would tell
/// another ratio.
std::vector<EffectRow> paired_effects(std::span<const ResultRow> rows, const std::vector<ComparedPoint>& compared,
                                      const PointSet& not_repeatable = {}, std::span<const ReferenceNoise> noise = {});

/// What `technique` `point` changes about one error of `against_technique` `against_point`, as paired_effects() has it,
/// of any two points: `asked` names them, with shot, target, metric and mask. None where either has no such error.
using PairedErrors = std::function<std::optional<EffectRow>(const EffectRow& asked)>;

/// Refers to `rows` and `noise`, which must outlive it.
PairedErrors paired_errors(std::span<const ResultRow> rows, const std::vector<ComparedPoint>& compared,
                           const PointSet& not_repeatable = {}, std::span<const ReferenceNoise> noise = {});

/// The same of the squared bias and of the variance by themselves, of each shot's last frame: whether a point wins by
/// the one or by the other. As all pairs of the common seeds tell them, two seeds or more; intervals from three on.
std::vector<EffectRow> split_effects(std::span<const SplitRow> rows, const std::vector<ComparedPoint>& compared,
                                     const PointSet& not_repeatable = {});

/// EffectRow::verdict.
namespace verdict {
inline constexpr const char* less = "less";
inline constexpr const char* more = "more";
inline constexpr const char* equivalent = "equivalent";  ///< neither, and certainly within the margin of each other
inline constexpr const char* undecided = "undecided";    ///< chance may have made the difference, or hidden one
inline constexpr const char* equal = "equal";            ///< to the last digit, of pairs (pairs.h)
}  // namespace verdict

/// p-values of a pair: of "both are alike", and of "they are further apart than the margin".
struct PairP {
    double different = 1, beyond = 1;
};

/// By adjusted p-values.
inline const char* verdict_of(const PairP& p, double ratio) {
    return p.different < significance ? (ratio < 1 ? verdict::less : verdict::more)
           : p.beyond < significance  ? verdict::equivalent
                                      : verdict::undecided;
}

/// The adjusted p-values of a comparison that another family has decided; none of all others.
using DecidedPair = std::function<std::optional<PairP>(const EffectRow&)>;

/// Decides `verdict` of all effects that have a p and whose interval holds all that is random, at 0.05; others (where
/// the reference's noise is not known) have no verdict. The effects on one error (target, metric, mask), of all points
/// and shots, are a family, whose p-values are adjusted together (holm_adjusted()): among many comparisons some come
/// out small by chance. `low_holm` and `high_holm` are intervals at the level that each is judged at, so that they
/// agree with the verdict: 0.05 over the factor by which p was adjusted. The `primary` family is what the study was
/// made to compare; in `exploratory` ones what is significant is so among the effects on that error alone. A pair has
/// one verdict: of what `decided` knows (decided_by_standings()), too, the larger p counts.
void set_verdicts(std::span<EffectRow> effects, const PrimaryComparisons& primary, const DecidedPair& decided = {});
