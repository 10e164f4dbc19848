#pragma once
#include "metrics/plane.h"
#include "metrics/statistics/estimates.h"

#include <array>
#include <optional>
#include <span>
#include <vector>

// Intervals of metrics that are no means of squares (FLIP, absolute differences), extrapolated to a reference
// without noise: metrics/README.md, "Intervals of FLIP and absolute differences".

/// The noise variance of a reference R grows to 4 times if R moves by this multiple of (A - B) / 2. A and B: its
/// halves.
inline constexpr double extrapolation_step = 1.7320508075688772;  // sqrt(3)

/// What a mean may be without noise: the mean itself, or its extrapolation by either law of without_noise().
struct Extrapolated {
    double own, of_power, of_bounded;

    std::array<double, 3> all() const { return {own, of_power, of_bounded}; }
    double low() const;
    double high() const;
};

/// Extrapolates a mean to a reference without noise. `at_one`, `at_two`, `at_four`: the mean against references with 1,
/// 2 and 4 times the reference's noise variance. Laws, with v the variance: m + b v^p with 0.25 <= p <= 1, and a + b /
/// (c + v).
Extrapolated without_noise(double at_one, double at_two, double at_four);

/// How the mean of a map over a mask grows with the reference's noise: `growth_groups` numbers for each GrowthColumn,
/// one column after another. Tiles (metrics/tiles.h) are dealt to the groups in turn, alike for all images of one
/// extent. The numbers of a column add up to the mean, and can be averaged over seeds or frames. Empty below two tiles.
using NoiseGrowth = std::vector<float>;
inline constexpr size_t growth_groups = 32;
enum class GrowthColumn {
    share,    ///< part of the pixels
    at_one,   ///< part of the mean against the reference
    at_two,   ///< part of the mean against the halves
    at_four,  ///< part of the mean against the reference moved by `extrapolation_step`
    swapped   ///< half the change of the mean when half A replaces half B as the reference
};

/// `maps`: one metric's maps against the reference, half A, half B, and the reference moved past A and past B.
NoiseGrowth noise_growth(const std::array<const Plane*, 5>& maps, const Mask& mask);

/// The mean with and without the noise; none if `growth` is empty.
std::optional<Extrapolated> extrapolated_mean(const NoiseGrowth& growth);

/// Whether the mean grows as the laws allow. Its growth from 2 to 4 times the variance is 0.6 to 2.5 times its growth
/// from 1 to 2 times (laws: 0.6 to 2; estimates scatter). Or its whole growth is below half the noise's interval. Rare
/// bright paths, which a half shows not at all or twice too strong, break the laws. False if `growth` is empty.
bool follows_a_law(const NoiseGrowth& growth);

/// The 95 % interval that the reference's noise leaves to the mean: the range of `Extrapolated`, widened by
///
/// - GrowthColumn::swapped. Its squares add up over tiles, as those of pixels do in noise_half_width(): windows make
///   neighbours share noise, but reach less far than a tile (metrics/tiles.h). Student's t has 3 (sum of s^2)^2 / (sum
///   of s^4) degrees of freedom, the number of tiles if all are alike;
/// - on the extrapolated side, the disagreement of the tiles about the extrapolation (jackknife_variance()).
///
/// None if `growth` is empty. metrics/coverage.md has the measured coverage.
std::optional<Interval> extrapolated_interval(const NoiseGrowth& growth);

/// Uncertainty of ln(a / b) from the noise of the common reference, for two means over one mask. One part is the change
/// of the ratio when half A replaces half B as the reference, in which shared noise cancels. The other is the
/// disagreement of the tiles about the extrapolated ratio. One law extrapolates both means, so equal errors stay equal.
/// `excess_of_a` and `excess_of_b`: how far either law moves the ratio. None if noise hides a mean: by one law, with or
/// without one group, nothing is left of the mean.
std::optional<SharedScatter> extrapolated_scatter(const NoiseGrowth& a, const NoiseGrowth& b);
