#include "metrics/flip_filters.h"

#include <cmath>
#include <functional>
#include <numbers>

namespace {

/// out[x] += weight (right[x] +- left[x]): the inner loop of all filters, kept plain for the compiler's vectoriser.
template <bool is_odd>
void accumulate(float* __restrict out, const float* left, const float* right, float weight, unsigned count) {
    for (unsigned x = 0; x < count; ++x) out[x] += weight * (is_odd ? right[x] - left[x] : right[x] + left[x]);
}

void accumulate_pair(const Kernel& kernel, unsigned k, float* out, const float* left, const float* right,
                     unsigned count) {
    if (kernel.is_odd)
        accumulate<true>(out, left, right, kernel.right[k], count);
    else
        accumulate<false>(out, left, right, kernel.right[k], count);
}

/// Taps value(0) ... value(radius), scaled so that all 2 radius + 1 sum to 1.
Kernel normalised(unsigned radius, const std::function<double(double)>& value) {
    double sum = value(0);
    for (unsigned u = 1; u <= radius; ++u) sum += 2 * value(u);
    Kernel kernel;
    for (unsigned u = 0; u <= radius; ++u) kernel.right.push_back(float(value(u) / sum));
    return kernel;
}

/// Scaled so that the positive taps sum to 1 and the negative ones to -1.
Kernel balanced(unsigned radius, bool is_odd, const std::function<double(double)>& value) {
    double positive = 0, negative = 0;
    for (int u = -int(radius); u <= int(radius); ++u) {
        const double v = value(u);
        (v > 0 ? positive : negative) += std::abs(v);
    }
    Kernel kernel{.right = {}, .is_odd = is_odd};
    for (unsigned u = 0; u <= radius; ++u) {
        const double v = value(u);
        kernel.right.push_back(float(v / (v > 0 ? positive : negative)));
    }
    if (is_odd) kernel.right[0] = 0;
    return kernel;
}

/// The transform of a contrast sensitivity exp(-b f^2) is a Gaussian exp(-pi^2 x^2 / b), x in degrees.
std::function<double(double)> sensitivity(double b, double pixels_per_degree) {
    return [=](double u) { return std::exp(-std::pow(std::numbers::pi * u / pixels_per_degree, 2) / b); };
}

/// The two-dimensional sensitivity of Cz is a1 g(b1) + a2 g(b2), each separable; together they sum to 1.
void blue_yellow(FlipKernels& kernels, double pixels_per_degree) {
    constexpr double a[2] = {34.1, 13.5}, b[2] = {0.04, 0.025};
    double sums[2];
    std::function<double(double)> taps[2];
    for (int i = 0; i < 2; ++i) {
        taps[i] = [=, g = sensitivity(b[i], pixels_per_degree)](double u) {
            return std::sqrt(a[i] * std::sqrt(std::numbers::pi / b[i])) * g(u);
        };
        sums[i] = taps[i](0);
        for (unsigned u = 1; u <= kernels.color_radius; ++u) sums[i] += 2 * taps[i](u);
    }
    const double scale = 1 / std::hypot(sums[0], sums[1]);
    for (unsigned u = 0; u <= kernels.color_radius; ++u) {
        kernels.blue_yellow_1.right.push_back(float(scale * taps[0](u)));
        kernels.blue_yellow_2.right.push_back(float(scale * taps[1](u)));
    }
}

}  // namespace

FloatPlane filter_rows(const FloatPlane& in, const Kernel& kernel) {
    const unsigned radius = kernel.radius();
    FloatPlane out(in.width - 2 * radius, in.height);
    for (unsigned y = 0; y < out.height; ++y) {
        const float* center = in.row(y) + radius;
        float* to = out.row(y);
        for (unsigned x = 0; x < out.width; ++x) to[x] = kernel.right[0] * center[x];
        for (unsigned k = 1; k <= radius; ++k) accumulate_pair(kernel, k, to, center - k, center + k, out.width);
    }
    return out;
}

FloatPlane filter_columns(const FloatPlane& in, const Kernel& kernel) {
    const unsigned radius = kernel.radius();
    FloatPlane out(in.width, in.height - 2 * radius);
    for (unsigned y = 0; y < out.height; ++y) {
        const float* center = in.row(y + radius);
        float* to = out.row(y);
        for (unsigned x = 0; x < out.width; ++x) to[x] = kernel.right[0] * center[x];
        for (unsigned k = 1; k <= radius; ++k)
            accumulate_pair(kernel, k, to, in.row(y + radius - k), in.row(y + radius + k), out.width);
    }
    return out;
}

FlipKernels flip_kernels(float pixels_per_degree) {
    constexpr double achromatic_b = 0.0047, red_green_b = 0.0053, widest_b = 0.04;  // table 1 of the paper
    constexpr double feature_width = 0.082;                                         // degrees; section 4.2
    const double ppd = pixels_per_degree;
    const double sigma = 0.5 * feature_width * ppd;

    FlipKernels kernels;
    kernels.color_radius =
        unsigned(std::ceil(3 * std::sqrt(widest_b / (2 * std::numbers::pi * std::numbers::pi)) * ppd));
    kernels.feature_radius = unsigned(std::ceil(3 * sigma));
    kernels.achromatic = normalised(kernels.color_radius, sensitivity(achromatic_b, ppd));
    kernels.red_green = normalised(kernels.color_radius, sensitivity(red_green_b, ppd));
    blue_yellow(kernels, ppd);

    const auto gauss = [=](double u) { return std::exp(-u * u / (2 * sigma * sigma)); };
    kernels.feature_blur = normalised(kernels.feature_radius, gauss);
    kernels.feature_edge = balanced(kernels.feature_radius, true, [=](double u) { return -u * gauss(u); });
    kernels.feature_point =
        balanced(kernels.feature_radius, false, [=](double u) { return (u * u / (sigma * sigma) - 1) * gauss(u); });
    return kernels;
}
