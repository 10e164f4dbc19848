#include "metrics/extrapolation.h"

#include "metrics/quantiles.h"
#include "metrics/tiles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace {

Mask within_margin(const Mask& mask, const Plane& map) {
    Mask inside = mask;
    for (size_t i = 0; i < inside.inside.size(); ++i) inside.inside[i] = mask.inside[i] && map.within_margin(i);
    return inside;
}

/// Of the mean over `count` pixels, from the sums of both maps by tile.
std::optional<double> swapped_half_width(const std::vector<double>& a, const std::vector<double>& b,
                                         const std::vector<double>& counts) {
    double squares = 0, fourths = 0, tiles = 0, count = 0;
    for (size_t t = 0; t < a.size(); ++t) {
        const double square = (a[t] - b[t]) * (a[t] - b[t]) / 4;
        squares += square, fourths += square * square, tiles += counts[t] > 0, count += counts[t];
    }
    if (tiles < 2) return std::nullopt;
    if (squares == 0) return 0.0;
    const double degrees = std::clamp(3 * squares * squares / fourths, 1.0, tiles);
    return student_t_quantile(0.975, degrees) * std::sqrt(squares) / count;
}

/// From what is measured to the farther of both laws.
double correction(std::span<const double> sums) {
    const double own = sums[1] / sums[0];
    const Extrapolated found = without_noise(own, sums[2] / sums[0], sums[3] / sums[0]);
    return own - found.low > found.high - own ? found.low - own : found.high - own;
}

}  // namespace

Extrapolated without_noise(double at_one, double at_two, double at_four) {
    const double first = at_two - at_one, second = at_four - at_two;
    if (first == 0) return {at_one, at_one};
    const double growth = second / first;
    // m + b v^p: the growth is 2^p.
    const double of_power = at_one - first / (std::clamp(growth, std::sqrt(std::sqrt(2.0)), 2.0) - 1);
    // a + b / (c + v - 1): the growth is 2 c / (c + 3), and there is a pole before v = 0 where it is 0.5 or less.
    const double bounded_growth = std::max(growth, 0.6), c = 3 * bounded_growth / (2 - bounded_growth);
    const double of_bounded = growth < 2 ? at_one - first * (c + 1) / (c - 1) : at_one - first;
    return {std::min({at_one, of_power, of_bounded}), std::max({at_one, of_power, of_bounded})};
}

MapInterval extrapolated_interval(const Plane& map, std::span<const Plane> halves, std::span<const Plane> moved_on,
                                  const Mask& mask) {
    const Mask inside = within_margin(mask, map);
    const std::vector<double> of_a = tile_sums(halves[0], inside), of_b = tile_sums(halves[1], inside),
                              moved_a = tile_sums(moved_on[0], inside), moved_b = tile_sums(moved_on[1], inside);
    std::array<std::vector<double>, 4> columns{tile_counts(inside), tile_sums(map, inside), of_a, moved_a};
    for (size_t t = 0; t < of_a.size(); ++t) {
        columns[2][t] = (of_a[t] + of_b[t]) / 2;
        columns[3][t] = (moved_a[t] + moved_b[t]) / 2;
    }
    const std::optional<double> half_width = swapped_half_width(of_a, of_b, columns[0]),
                                of_correction = jackknife_half_width(columns, correction);
    if (!half_width || !of_correction) return {};
    const std::vector<double> sums = totals(columns);
    const double own = sums[1] / sums[0];
    const Extrapolated found = without_noise(own, sums[2] / sums[0], sums[3] / sums[0]);
    const auto widened = [&](double end) { return std::hypot(*half_width, end == own ? 0.0 : *of_correction); };
    return {found.low - widened(found.low), found.high + widened(found.high)};
}
