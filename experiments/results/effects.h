#pragma once
#include "experiments/results/cell.h"
#include "experiments/study/config/comparisons.h"

#include <set>
#include <span>

/// What a point changes about one error of another, its baseline, or about its squared bias or its variance.
struct EffectRow {
    std::string shot, frame, variant, point;
    std::string against;  ///< baseline_name, or "estimator=a": the point that differs in this value alone
    std::string against_variant, against_point, target, metric, formula, mask;
    size_t seeds = 0;  ///< that both were run with; a point that does not depend on seeds has all
    std::optional<double>
        ratio;  ///< mean error of the point / of the baseline, over the seeds; none if one is not above 0
    std::optional<double> low, high, p;  ///< 95 % interval; two-sided p of "the ratio is 1", see jackknifed_ratio()
    std::string interval;                ///< what the interval holds, or why there is none (interval.h)
    std::string family;                  ///< "primary" or "exploratory", see set_families()
    std::optional<double> p_holm;        ///< p adjusted for the whole primary family; none of exploratory effects

    static constexpr auto columns() {
        return std::tuple(
            Column{"shot", &EffectRow::shot}, Column{"frame", &EffectRow::frame},
            Column{"variant", &EffectRow::variant}, Column{"point", &EffectRow::point},
            Column{"against", &EffectRow::against}, Column{"against_variant", &EffectRow::against_variant},
            Column{"against_point", &EffectRow::against_point}, Column{"target", &EffectRow::target},
            Column{"metric", &EffectRow::metric}, Column{"formula", &EffectRow::formula},
            Column{"mask", &EffectRow::mask}, Column{"seeds", &EffectRow::seeds}, Column{"ratio", &EffectRow::ratio},
            Column{"low", &EffectRow::low}, Column{"high", &EffectRow::high}, Column{"interval", &EffectRow::interval},
            Column{"p", &EffectRow::p}, Column{"family", &EffectRow::family}, Column{"p_holm", &EffectRow::p_holm});
    }
};

/// (variant, point)
using PointSet = std::set<std::pair<std::string, std::string>>;

/// All comparisons_of() `variants` by errors for which less is better, over the seeds that both have
/// (jackknifed_ratio()): the ratio of the mean errors, since a mean of the seeds' ratios would hide what few seeds with
/// large errors cost. Only rows that speak
/// for their shot count.
///
/// Intervals hold the scatter over the seeds and, where `noise` has both points, what the noise of their common
/// reference leaves of the ratio. No interval and no p are given for a single seed of a point that depends on it, nor
/// if one of both is in `not_repeatable`: seeds do not share what such points add by chance, and another run would tell
/// another ratio.
std::vector<EffectRow> paired_effects(std::span<const ResultRow> rows, const std::vector<VariantConfig>& variants,
                                      const PointSet& not_repeatable = {}, std::span<const ReferenceNoise> noise = {});

/// The same of the squared bias and of the variance by themselves, of each shot's last frame: whether a point wins by
/// the one or by the other. As all pairs of the common seeds tell them, two seeds or more; intervals from three on.
std::vector<EffectRow> split_effects(std::span<const SplitRow> rows, const std::vector<VariantConfig>& variants,
                                     const PointSet& not_repeatable = {});

/// The effects on the primary error, of all points and shots, are one family, whose p-values are adjusted together
/// (holm_adjusted()): among many comparisons some come out small by chance. All others are exploratory: their intervals
/// and p hold for each by itself, and what they suggest is for another study to show.
void set_families(std::span<EffectRow> effects, const PrimaryComparisons& primary);
