#pragma once
#include "metrics/float_plane.h"

#include <vector>

/// One-dimensional taps of 2 radius + 1 values; tap(-u) = tap(u), or -tap(u) if `is_odd`.
struct Kernel {
    std::vector<float> right;  ///< taps 0 ... radius
    bool is_odd = false;
    unsigned radius() const { return unsigned(right.size()) - 1; }
};

/// Convolutions. The result is narrower (or lower) than `in` by 2 radius: it lacks the pixels whose taps leave `in`.
FloatPlane filter_rows(const FloatPlane& in, const Kernel& kernel);
FloatPlane filter_columns(const FloatPlane& in, const Kernel& kernel);

/// All kernels of FLIP for one resolution of the observer (Andersson et al. 2020, sections 4.1.1 and 4.2).
struct FlipKernels {
    Kernel achromatic, red_green;                      ///< contrast sensitivity: Y, Cx
    Kernel blue_yellow_1, blue_yellow_2;               ///< and Cz, whose two separable filters are added
    Kernel feature_blur, feature_edge, feature_point;  ///< Gaussian, its first and its second derivative
    unsigned color_radius, feature_radius;             ///< color_radius >= feature_radius
};

FlipKernels flip_kernels(float pixels_per_degree);
