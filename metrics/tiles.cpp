#include "metrics/tiles.h"

#include "metrics/statistics/quantiles.h"
#include "metrics/statistics/summation.h"

#include <algorithm>
#include <cmath>

namespace {

template <class Value>
std::vector<double> sums_by_tile(const Mask& mask, const Value& value) {
    const unsigned columns = (mask.extent.x + tile_size - 1) / tile_size;
    const unsigned rows = (mask.extent.y + tile_size - 1) / tile_size;
    std::vector<double> sums(size_t(columns) * rows);
    for (unsigned y = 0; y < mask.extent.y; ++y)
        for (unsigned x = 0; x < mask.extent.x; ++x) {
            const size_t i = size_t(y) * mask.extent.x + x;
            if (mask.inside[i]) sums[size_t(y / tile_size) * columns + x / tile_size] += value(i);
        }
    return sums;
}

}  // namespace

std::vector<double> tile_sums(const Plane& plane, const Mask& mask) {
    return sums_by_tile(mask, [&](size_t i) { return plane.values[i]; });
}

std::vector<double> tile_counts(const Mask& mask) {
    return sums_by_tile(mask, [](size_t) { return 1.0; });
}

std::vector<double> totals(std::span<const std::vector<double>> columns) {
    std::vector<double> sums;
    for (const std::vector<double>& column : columns)
        sums.push_back(ordered_sum(column.size(), [&](size_t i) { return column[i]; }));
    return sums;
}

std::optional<double> jackknife_variance(std::span<const std::vector<double>> columns,
                                         const std::function<double(std::span<const double>)>& statistic) {
    const std::vector<double> all = totals(columns);
    std::vector<double> replicas, without(columns.size());
    for (size_t tile = 0; tile < columns[0].size(); ++tile) {
        if (columns[0][tile] == 0) continue;
        for (size_t c = 0; c < columns.size(); ++c) without[c] = all[c] - columns[c][tile];
        replicas.push_back(statistic(without));
    }
    if (replicas.size() < 2) return std::nullopt;
    const double n = double(replicas.size());
    const double mean = ordered_sum(replicas.size(), [&](size_t i) { return replicas[i]; }) / n;
    const double squares =
        ordered_sum(replicas.size(), [&](size_t i) { return (replicas[i] - mean) * (replicas[i] - mean); });
    const double variance = (n - 1) / n * squares;
    return std::isfinite(variance) ? std::optional(variance) : std::nullopt;
}

std::optional<double> jackknife_half_width(std::span<const std::vector<double>> columns,
                                           const std::function<double(std::span<const double>)>& statistic) {
    const std::optional<double> variance = jackknife_variance(columns, statistic);
    if (!variance) return {};
    const double tiles = double(std::ranges::count_if(columns[0], [](double count) { return count != 0; }));
    return student_t_quantile(0.975, tiles - 1) * std::sqrt(*variance);
}
