#pragma once
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

/// The false-alarm rate of every verdict ("better", "worse", "behind", "changed"), for a family of comparisons (Holm).
inline constexpr double significance = 0.05;

/// The factor between p and `p_holm` among `count` p-values (holm_adjusted()). An interval of error probability
/// significance / factor agrees with the verdict. A p_holm cut off at 1 means a factor of at least 1 / p.
inline double adjustment_factor(double p, double p_holm, size_t count) {
    return !(p > 0) ? double(count) : p_holm < 1 ? std::max(1.0, p_holm / p) : std::max(double(count), 1 / p);
}

/// Sets `low_holm` and `high_holm` to the ends of an interval at the adjusted level; leaves them empty if it is
/// unbounded.
template <class Effect>
void set_adjusted_interval(Effect& effect, std::pair<double, double> ends) {
    if (std::isfinite(ends.second)) effect.low_holm = ends.first, effect.high_holm = ends.second;
}

/// What a 95 % interval includes, or why there is none: the column `interval` of summary.csv and effects.csv, for
/// report and figures.
namespace interval {

inline constexpr const char* reference_and_seeds = "reference and seeds";
inline constexpr const char* reference = "reference";
inline constexpr const char* seeds = "seeds";  ///< the reference is exact, or its noise does not affect the number
inline constexpr const char* pixels_and_seeds = "pixels and seeds";
inline constexpr const char* pixels = "pixels";  ///< for sequences of frames: the choice of pixels

inline constexpr const char* no_value = "none: no value";
inline constexpr const char* one_seed = "none: 1 seed";
inline constexpr const char* too_few_seeds = "none: too few seeds";
inline constexpr const char* open_end = "none: no upper end";
inline constexpr const char* no_end = "none: lost in the reference's noise";
/// One pixel carries the reference's noise, or the mask holds too few samples to meet rare paths: see
/// noise_half_width().
inline constexpr const char* few_paths = "none: few paths carry the reference's noise";
inline constexpr const char* one_tile = "none: pixels within one tile";  ///< the scatter by choice of pixels is unknown
inline constexpr const char* unknown_reference = "none: reference's noise not known";
inline constexpr const char* not_repeatable = "none: not repeatable";
inline constexpr const char* not_positive = "none: an error is not above 0";

}  // namespace interval
