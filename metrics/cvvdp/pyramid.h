#pragma once
#include "metrics/float_plane.h"

#include <glm/glm.hpp>
#include <vector>

/// The least width and height that has a pyramid.
inline constexpr unsigned least_pyramid_side = 4;

/// The spatial frequencies (cycles per degree) of the bands of an image, from the finest one to the base band. One
/// more than the levels below the image. Fails with Error if a side is below least_pyramid_side, or if
/// `pixels_per_degree` is outside [1, 1000].
std::vector<double> band_frequencies(glm::uvec2 extent, double pixels_per_degree);

/// The next coarser level: 5 taps, and every second pixel. Sizes are halved and rounded up; both are at least 2.
///
/// As in the original program, the last column is weighted by the parity of the number of rows. It is too bright where
/// the width is even and the height odd, and too dark in the opposite case.
void reduce(const FloatPlane& fine, FloatPlane& coarse);

/// Row `y` of a coarse level enlarged to `width` pixels; `scratch` is overwritten.
void expand_row(const FloatPlane& coarse, unsigned y, float* row, unsigned width, std::vector<float>& scratch);

/// The level sizes below `extent`, `levels` of them.
std::vector<glm::uvec2> coarser_sizes(glm::uvec2 extent, unsigned levels);
