#pragma once
#include "metrics/plane.h"
#include "metrics/statistics/summation.h"

#include <cmath>
#include <span>

/// The number of pixels inside the mask where the plane carries values.
inline size_t pooled_count(const Plane& plane, const Mask& mask) {
    size_t n = 0;
    for (size_t i = 0; i < plane.values.size(); ++i) n += mask.inside[i] && plane.within_margin(i);
    return n;
}

/// The mean of those pixels; NaN (0 / 0) if there is none.
inline double masked_mean(const Plane& plane, const Mask& mask) {
    const double sum = ordered_sum(plane.values.size(), [&](size_t i) {
        return mask.inside[i] && plane.within_margin(i) ? plane.values[i] : 0.0;
    });
    return sum / double(pooled_count(plane, mask));
}

/// The sum over the pixels inside the mask, for planes without a margin.
inline double masked_sum(const Plane& plane, const Mask& mask) {
    return ordered_sum(plane.values.size(), [&](size_t i) { return mask.inside[i] ? plane.values[i] : 0.0; });
}

/// How most metrics pool their one layer.
inline double pooled_mean(std::span<const Plane> layers, const Mask& mask) { return masked_mean(layers[0], mask); }

/// Of a mean of squares that are relative to the square of the largest value.
inline double decibels(double mean_square) { return -10 * std::log10(mean_square); }
inline double decibels_of_mean(std::span<const Plane> layers, const Mask& mask) {
    return decibels(masked_mean(layers[0], mask));
}

/// Metric::mean_map of metrics whose first layer it is.
inline Plane first_layer(std::span<const Plane> layers, const Mask&) { return layers[0]; }
