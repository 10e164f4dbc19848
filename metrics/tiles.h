#pragma once
#include "metrics/plane.h"

#include <functional>
#include <optional>
#include <span>
#include <vector>

// Filters and histories spread noise, so neighbouring pixels share it. Intervals are therefore made from tiles, inside
// which noise may be correlated.
inline constexpr unsigned tile_size = 16;  // pixels

/// The sum of a plane's masked pixels in each tile, all tiles row by row: equally long for all planes of one extent.
std::vector<double> tile_sums(const Plane& plane, const Mask& mask);

/// The number of masked pixels in each tile.
std::vector<double> tile_counts(const Mask& mask);

/// The variance of a number made from sums over the masked pixels. `columns` are tile sums, columns[0] the tile counts;
/// `statistic` takes the total of each column. The method is a delete-one jackknife over the tiles with a masked pixel
/// (Efron, Tibshirani 1993, "An Introduction to the Bootstrap", chapter 11). Tiles count as a sample, so differences
/// between parts of the image add uncertainty. For another run of the same shot the variance is therefore too large
/// rather than too small. None below two such tiles, or if the statistic is not finite.
std::optional<double> jackknife_variance(std::span<const std::vector<double>> columns,
                                         const std::function<double(std::span<const double>)>& statistic);

/// Half the width of the 95 % interval of the same number, with Student's t.
std::optional<double> jackknife_half_width(std::span<const std::vector<double>> columns,
                                           const std::function<double(std::span<const double>)>& statistic);

/// The total of each column.
std::vector<double> totals(std::span<const std::vector<double>> columns);
