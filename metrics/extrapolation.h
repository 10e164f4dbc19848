#pragma once
#include "metrics/plane.h"
#include "metrics/statistics/estimates.h"

#include <array>
#include <optional>
#include <span>
#include <vector>

// Intervals of metrics that are no means of squares (FLIP, absolute differences), extrapolated to a reference
// without noise: metrics/README.md, "Intervals of FLIP and absolute differences".

/// The reference R moved by so many times (A - B) / 2 has 4 times the variance of its noise.
inline constexpr double extrapolation_step = 1.7320508075688772;  // sqrt(3)

/// Range of a mean without noise: of two laws of its growth, and the mean itself.
struct Extrapolated {
    double own, of_power, of_bounded;

    std::array<double, 3> all() const { return {own, of_power, of_bounded}; }
    double low() const;
    double high() const;
};

/// `at_one`, `at_two`, `at_four`: the mean against references whose noise has so many times the variance v of the
/// reference's own. Laws: m + b v^p with 0.25 <= p <= 1, and a + b / (c + v).
Extrapolated without_noise(double at_one, double at_two, double at_four);

/// How the mean of a map over a mask grows with the reference's noise: `growth_groups` numbers of each of GrowthColumn,
/// one column after another. Tiles (metrics/tiles.h) take turns in the groups, the same for all images of one extent.
/// Parts of the mean, so that they add up to it, and those of several seeds or frames can be averaged. Empty where it
/// is not known: below two tiles.
using NoiseGrowth = std::vector<float>;
inline constexpr size_t growth_groups = 32;
enum class GrowthColumn {
    share,    ///< of the pixels
    at_one,   ///< of the mean against the reference
    at_two,   ///< against its halves
    at_four,  ///< against both moved on
    swapped   ///< half the change when half A is believed in place of half B
};

/// `maps`: of one metric against the reference, its halves A and B, and the reference moved on to the side of either.
NoiseGrowth noise_growth(const std::array<const Plane*, 5>& maps, const Mask& mask);

/// The mean with and without the noise; none of an empty growth.
std::optional<Extrapolated> extrapolated_mean(const NoiseGrowth& growth);

/// Whether the mean grows as the laws say that it may: from twice to four times the variance by 0.6 to 2.5 times what
/// it grew by before, or in all by less than half the width that the noise gives its interval. The laws allow 0.6 to 2,
/// and estimates scatter. Rare bright paths, of which a half shows either none or twice too much, make it grow
/// otherwise. False of an empty one.
bool follows_a_law(const NoiseGrowth& growth);

/// The 95 % interval that the reference's noise leaves to the mean. Where the mean would lie without noise, widened by
///
/// - half its change when half A is believed in place of half B, summed over tiles, whose squares add up as those of
///   pixels do in noise_half_width(): windows make neighbours share noise, but reach less far than a tile
///   (metrics/tiles.h). Student's t has 3 (sum of s^2)^2 / (sum of s^4) degrees of freedom, the number of tiles where
///   all are alike;
/// - on the side that is extrapolated to, by how well the tiles agree on how far (jackknife_variance()).
///
/// None of an empty one. metrics/README.md has the measured coverage.
std::optional<Interval> extrapolated_interval(const NoiseGrowth& growth);

/// What the noise of their common reference leaves of ln(a / b), two means over one mask: the change of the ratio when
/// half A is believed in place of half B, in which what both share cancels, and how well the tiles agree on how far it
/// is to the ratio without noise. Both are extrapolated by the same law, so that points of like errors stay alike;
/// how far either law moves the ratio is in `excess_of_a` and `excess_of_b`. None where a mean is lost in the noise: a
/// law, with or without one of the groups, says that nothing is left of it.
std::optional<SharedScatter> extrapolated_scatter(const NoiseGrowth& a, const NoiseGrowth& b);
