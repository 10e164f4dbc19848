#pragma once
#include "experiments/cell.h"
#include "experiments/config.h"

#include <set>
#include <span>

/// EffectRow::against of points that are compared with a point marked as a baseline.
inline const std::string baseline_name = "baseline";

/// What a point changes about one error of another, its baseline, or about its squared bias or its variance.
struct EffectRow {
    std::string shot, frame, variant, point;
    std::string against;  ///< baseline_name, or "estimator=a": the point that differs in this value alone
    std::string against_variant, against_point, target, metric, formula, mask;
    size_t seeds = 0;  ///< that both were run with
    std::optional<double>
        ratio;  ///< mean error of the point / of the baseline, over the seeds; none if one is not above 0
    std::optional<double> low, high, p;  ///< 95 % interval; two-sided p of "the ratio is 1", see jackknifed_ratio()
    std::optional<double> p_holm;        ///< p adjusted for all rows of equal target, metric and mask: baselines' apart
};

/// Whether less of the metric is better: such are never negative, but for the correction of noise.
bool is_error(const std::string& metric);

/// Every point against every point marked as a baseline, and those with VariantConfig::against against that, by errors
/// for which less is better, over the seeds that both have (jackknifed_ratio()): the ratio of the mean errors, since a
/// mean of the seeds' ratios would hide what few seeds with large errors cost. Of a shot's rows those over its frames
/// count where there are such ("all"), else those of its last frame.
///
/// No interval and no p are given for a single seed, nor if one of both is in `not_repeatable` (variant, point): seeds
/// do not share what such points add by chance, and another run would tell another ratio.
std::vector<EffectRow> paired_effects(std::span<const ResultRow> rows, const std::vector<VariantConfig>& variants,
                                      const std::set<std::pair<std::string, std::string>>& not_repeatable = {});

/// The same of the squared bias and of the variance by themselves, of each shot's last frame: whether a point wins by
/// the one or by the other. As all pairs of the common seeds tell them, two seeds or more; intervals from three on.
std::vector<EffectRow> split_effects(std::span<const SplitRow> rows, const std::vector<VariantConfig>& variants,
                                     const std::set<std::pair<std::string, std::string>>& not_repeatable = {});

/// effects.csv. Only the header where no baseline is marked.
void write_effects(const std::filesystem::path& folder, std::span<const EffectRow> effects);
