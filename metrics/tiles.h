#pragma once
#include "metrics/plane.h"

#include <functional>
#include <optional>
#include <span>
#include <vector>

// Neighbouring pixels share noise: filters and histories spread it. Intervals are therefore made from tiles, inside of
// which it may be correlated.
inline constexpr unsigned tile_size = 16;  // pixels

/// The sum of a plane's masked pixels in each tile, all tiles row by row: equally long for all planes of one extent.
std::vector<double> tile_sums(const Plane& plane, const Mask& mask);

/// The number of masked pixels in each tile.
std::vector<double> tile_counts(const Mask& mask);

/// The variance of a number that is made of sums over the masked pixels: `columns` are tile sums, columns[0] the tile
/// counts, and `statistic` takes the total of each column. Delete-one jackknife over the tiles that hold a masked pixel
/// (Efron, Tibshirani 1993, "An Introduction to the Bootstrap", chapter 11). It takes the tiles for a sample: what
/// differs from one part of the image to the next counts as uncertainty, so it is rather too wide than too narrow for
/// what another run of the same shot would give. None below two such tiles, or where the statistic is not finite.
std::optional<double> jackknife_variance(std::span<const std::vector<double>> columns,
                                         const std::function<double(std::span<const double>)>& statistic);

/// Half the width of the 95 % interval of that number, with Student's t.
std::optional<double> jackknife_half_width(std::span<const std::vector<double>> columns,
                                           const std::function<double(std::span<const double>)>& statistic);

/// The total of each column.
std::vector<double> totals(std::span<const std::vector<double>> columns);
