#include "metrics/extrapolation.h"

#include "metrics/statistics/quantiles.h"
#include "metrics/tiles.h"

#include <algorithm>
#include <cmath>

namespace {

using enum GrowthColumn;
constexpr size_t growth_columns = size_t(swapped) + 1;

std::vector<double> column(const NoiseGrowth& growth, GrowthColumn which) {
    const auto first = growth.begin() + std::ptrdiff_t(size_t(which) * growth_groups);
    return {first, first + growth_groups};
}

/// The columns that means are extrapolated from, as jackknife_variance() takes them.
std::vector<std::vector<double>> mean_columns(const NoiseGrowth& growth) {
    return {column(growth, share), column(growth, at_one), column(growth, at_two), column(growth, at_four)};
}

Mask within_margin(const Mask& mask, const Plane& map) {
    Mask inside = mask;
    for (size_t i = 0; i < inside.inside.size(); ++i) inside.inside[i] = mask.inside[i] && map.within_margin(i);
    return inside;
}

double occupied(const std::vector<double>& shares) {
    return double(std::ranges::count_if(shares, [](double share) { return share > 0; }));
}

/// Of the interval, by the change when half A is believed in place of half B alone.
double half_width_of(const NoiseGrowth& growth) {
    const SharedScatter noise = scatter_of_terms(column(growth, swapped), occupied(column(growth, share)));
    return noise.variance > 0 ? student_t_quantile(0.975, noise.degrees) * std::sqrt(noise.variance) : 0.0;
}

/// `sums` as mean_columns(), in total.
Extrapolated extrapolated(std::span<const double> sums) {
    return without_noise(sums[1] / sums[0], sums[2] / sums[0], sums[3] / sums[0]);
}

/// From what is measured to the farther of both laws.
double correction(std::span<const double> sums) {
    const Extrapolated found = extrapolated(sums);
    return found.own - found.low() > found.high() - found.own ? found.low() - found.own : found.high() - found.own;
}

}  // namespace

double Extrapolated::low() const { return std::min({own, of_power, of_bounded}); }
double Extrapolated::high() const { return std::max({own, of_power, of_bounded}); }

Extrapolated without_noise(double at_one, double at_two, double at_four) {
    const double first = at_two - at_one, second = at_four - at_two;
    if (first == 0) return {at_one, at_one, at_one};
    const double growth = second / first;
    // m + b v^p: the growth is 2^p.
    const double of_power = at_one - first / (std::clamp(growth, std::sqrt(std::sqrt(2.0)), 2.0) - 1);
    // a + b / (c + v - 1): the growth is 2 c / (c + 3), and there is a pole before v = 0 where it is 0.5 or less.
    const double bounded_growth = std::max(growth, 0.6), c = 3 * bounded_growth / (2 - bounded_growth);
    return {at_one, of_power, growth < 2 ? at_one - first * (c + 1) / (c - 1) : at_one - first};
}

NoiseGrowth noise_growth(const std::array<const Plane*, 5>& maps, const Mask& mask) {
    const Mask inside = within_margin(mask, *maps[0]);
    const std::vector<double> counts = tile_counts(inside);
    std::array<std::vector<double>, 5> sums_of;
    std::ranges::transform(maps, sums_of.begin(), [&](const Plane* map) { return tile_sums(*map, inside); });
    const auto& [own, of_a, of_b, moved_a, moved_b] = sums_of;
    const double count = double(inside.count());
    if (occupied(counts) < 2) return {};
    NoiseGrowth growth(growth_columns * growth_groups);
    std::vector<double> sums(growth.size());
    for (size_t t = 0; t < counts.size(); ++t) {
        const auto add = [&](GrowthColumn which, double sum) {
            sums[size_t(which) * growth_groups + t % growth_groups] += sum;
        };
        add(share, counts[t]), add(at_one, own[t]), add(at_two, (of_a[t] + of_b[t]) / 2);
        add(at_four, (moved_a[t] + moved_b[t]) / 2), add(swapped, (of_a[t] - of_b[t]) / 2);
    }
    std::ranges::transform(sums, growth.begin(), [&](double sum) { return float(sum / count); });
    return growth;
}

std::optional<Extrapolated> extrapolated_mean(const NoiseGrowth& growth) {
    if (growth.empty()) return {};
    return extrapolated(totals(mean_columns(growth)));
}

bool follows_a_law(const NoiseGrowth& growth) {
    if (growth.empty()) return false;
    const std::vector<double> sums = totals(mean_columns(growth));
    const double first = sums[2] - sums[1], second = sums[3] - sums[2];
    if (std::abs(first + second) <= half_width_of(growth)) return true;
    return second >= std::min(0.6 * first, 2.5 * first) && second <= std::max(0.6 * first, 2.5 * first);
}

std::optional<Interval> extrapolated_interval(const NoiseGrowth& growth) {
    if (growth.empty()) return {};
    const std::vector<std::vector<double>> columns = mean_columns(growth);
    const double groups = occupied(columns[0]);
    const std::optional<double> of_correction = jackknife_variance(columns, correction);
    if (!of_correction) return {};
    const double half_width = half_width_of(growth),
                 correction_half_width = student_t_quantile(0.975, groups - 1) * std::sqrt(*of_correction);
    const Extrapolated found = extrapolated(totals(columns));
    const auto widened = [&](double end) {
        return std::hypot(half_width, end == found.own ? 0.0 : correction_half_width);
    };
    return Interval{found.low() - widened(found.low()), found.high() + widened(found.high())};
}

std::optional<SharedScatter> extrapolated_scatter(const NoiseGrowth& a, const NoiseGrowth& b) {
    std::vector<std::vector<double>> columns = mean_columns(a);
    const double groups = occupied(columns[0]);
    for (std::vector<double>& of_b : mean_columns(b)) columns.push_back(std::move(of_b));
    const std::vector<double> sums = totals(columns), swapped_a = column(a, swapped), swapped_b = column(b, swapped);
    std::vector<double> changes;
    for (size_t g = 0; g < growth_groups; ++g) changes.push_back(swapped_a[g] / sums[1] - swapped_b[g] / sums[5]);
    SharedScatter shared = scatter_of_terms(changes, groups);

    // By each law, how far the logarithm of the ratio lies from that of what is measured.
    const auto shifts = [](std::span<const double> totals) {
        const std::array<double, 3> of_a = extrapolated(totals.first(4)).all(),
                                    of_b = extrapolated(totals.last(4)).all();
        std::array<double, 3> shifts{};
        for (size_t law = 1; law < shifts.size(); ++law)
            shifts[law] = std::log(of_a[law] / of_a[0]) - std::log(of_b[law] / of_b[0]);
        return shifts;
    };
    const std::array<double, 3> found = shifts(sums);
    for (const double shift : found)
        if (!std::isfinite(shift)) return {};
    shared.excess_of_a = -std::expm1(std::ranges::min(found));
    shared.excess_of_b = -std::expm1(-std::ranges::max(found));
    double of_shift = 0;
    for (size_t law = 1; law < found.size(); ++law) {
        const auto variance =
            jackknife_variance(columns, [&](std::span<const double> totals) { return shifts(totals)[law]; });
        if (!variance) return {};
        of_shift = std::max(of_shift, *variance);
    }
    const double variance = shared.variance + of_shift;
    if (variance > 0)
        shared.degrees = variance * variance /
                         (shared.variance * shared.variance / shared.degrees + of_shift * of_shift / (groups - 1));
    shared.variance = variance;
    return shared;
}
