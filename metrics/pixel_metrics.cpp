#include "metrics/pixel_metrics.h"

#include "metrics/pooling.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace {

/// The mean over the channels of error(r, x), for each pixel.
template <class Error>
std::vector<Plane> mean_of_channels(const HostImage& reference, const HostImage& test, const Error& error) {
    Plane map(reference.extent);
    tbb::parallel_for(0u, map.extent.y, [&](unsigned y) {
        for (unsigned x = 0; x < map.extent.x; ++x) {
            const float* r = reference.pixel(x, y);
            const float* t = test.pixel(x, y);
            double sum = 0;
            for (int c = 0; c < 3; ++c) sum += error(double(r[c]), double(t[c]));
            map.row(y)[x] = sum / 3;
        }
    });
    return {std::move(map)};
}

double square(double v) { return v * v; }

double one(double) { return 1; }
double weight_a(double r) { return 1 / (r * r + 0.01); }

template <double (*weight)(double)>
std::vector<Plane> weighted_squares(const ImagePair& pair) {
    return mean_of_channels(pair.reference, pair.test, [](double r, double x) { return weight(r) * square(x - r); });
}

std::vector<Plane> code_squares(const ImagePair& pair) {
    return mean_of_channels(pair.reference_codes, pair.test_codes, [](double r, double x) { return square(x - r); });
}

std::vector<Plane> absolutes(const ImagePair& pair) {
    return mean_of_channels(pair.reference, pair.test, [](double r, double x) { return std::abs(x - r); });
}

std::vector<Plane> symmetric_ratios(const ImagePair& pair) {
    return mean_of_channels(pair.reference, pair.test, [](double r, double x) {
        const double sum = std::abs(x) + std::abs(r);
        return sum > 0 ? std::abs(x - r) / sum : 0.0;
    });
}

std::vector<Plane> differences(const ImagePair& pair) {
    return mean_of_channels(pair.reference, pair.test, [](double r, double x) { return x - r; });
}

std::vector<Plane> both_means(const ImagePair& pair) {
    std::vector<Plane> layers = mean_of_channels(pair.reference, pair.test, [](double, double x) { return x; });
    layers.push_back(mean_of_channels(pair.reference, pair.test, [](double r, double) { return r; }).front());
    return layers;
}

/// 1 where any channel is off by more than ten times its reference.
std::vector<Plane> outlier_flags(const ImagePair& pair) {
    std::vector<Plane> sums = mean_of_channels(pair.reference, pair.test, [](double r, double x) {
        return std::abs(x - r) / (std::abs(r) + 0.01) > 10 ? 1.0 : 0.0;
    });
    for (double& v : sums[0].values) v = v > 0;
    return sums;
}

double sum(std::span<const Plane> layers, const Mask& mask) {
    const double count = double(pooled_count(layers[0], mask));
    return count > 0 ? std::round(masked_mean(layers[0], mask) * count) : std::numeric_limits<double>::quiet_NaN();
}

double ratio_of_means(std::span<const Plane> layers, const Mask& mask) {
    return masked_mean(layers[0], mask) / masked_mean(layers[1], mask);
}

Plane times_pixels(std::span<const Plane> layers, const Mask& mask) {
    Plane map = layers[0];
    const double count = double(mask.count());
    for (double& v : map.values) v *= count;
    return map;
}

std::vector<double> sorted_inside(const Plane& map, const Mask& mask) {
    std::vector<double> inside;
    for (size_t i = 0; i < map.values.size(); ++i)
        if (mask.inside[i]) inside.push_back(map.values[i]);
    std::ranges::sort(inside);
    return inside;
}

size_t kept_of(size_t pixels) { return pixels - pixels / 1000; }

/// The mean without the floor(0.1 %) largest.
double trimmed_mean(std::span<const Plane> layers, const Mask& mask) {
    const std::vector<double> inside = sorted_inside(layers[0], mask);
    const size_t kept = kept_of(inside.size());
    return ordered_sum(kept, [&](size_t i) { return inside[i]; }) / double(kept);
}

/// Each value up to the largest that is kept, less what those beyond would add: what a trimmed mean changes by if a
/// few pixels do (Huber 1981, "Robust Statistics", 3.3).
Plane winsorised(std::span<const Plane> layers, const Mask& mask) {
    const std::vector<double> inside = sorted_inside(layers[0], mask);
    const size_t count = inside.size(), kept = kept_of(count);
    Plane map = layers[0];
    if (kept == count) return map;
    const double largest = inside[kept - 1];
    for (double& v : map.values)
        v = (std::min(v, largest) * double(count) - largest * double(count - kept)) / double(kept);
    return map;
}

}  // namespace

std::vector<Metric> pixel_metrics() {
    using enum Better;
    // d = x - r: test minus reference, each channel by itself. Why so many relative errors: tools that print the same
    // name differ in the denominator, and the values by factors. Where r is path-traced its guide g is in the
    // denominator of those that are corrected, and the formula shows it: mean d^2 / (g^2 + 0.01).
    return {
        {"mse", "mse", "radiance^2", lower, "Mean of d^2, linear radiance", weighted_squares<one>, pooled_mean, one},
        {"mae", "mae", "radiance", lower, "Mean of |d|, linear radiance", absolutes, pooled_mean},
        {"relmse", "relmse_a", "1", lower,
         "Mean of d^2 / (r^2 + 0.01), linear radiance (Rousselle et al. 2011; tev, SimpleImageIO). With a path-traced "
         "reference, its guide replaces r in the denominator: relmse_a_guided",
         weighted_squares<weight_a>, pooled_mean, weight_a, "relmse_a_guided"},
        {"relmse_trimmed",
         "relmse_a_trimmed_0.1%",
         "1",
         lower,
         "Mean of relmse without the 0.1 % of pixels with the largest values. Hides fireflies: read it beside relmse "
         "and outliers",
         weighted_squares<weight_a>,
         trimmed_mean,
         nullptr,
         {},
         winsorised},
        {"outliers",
         "relative_error_above_10",
         "pixels",
         lower,
         "Number of pixels with |d| / (|r| + 0.01) > 10 in any channel, linear radiance",
         outlier_flags,
         sum,
         nullptr,
         {},
         times_pixels},
        {"smape", "smape_0_1", "1", lower,
         "Mean of |d| / (|x| + |r|), 0 where both are 0, linear radiance (figure-gen)", symmetric_ratios, pooled_mean},
        {"bias", "bias", "radiance", near_zero, "Mean of d, linear radiance", differences, pooled_mean},
        {"energy_ratio", "energy_ratio", "1", near_one, "Mean of x divided by the mean of r, linear radiance",
         both_means, ratio_of_means},
        {"psnr",
         "psnr_code",
         "dB",
         higher,
         "-10 log10 of the mean of d^2, sRGB codes from 0 to 1; infinite for equal images",
         code_squares,
         decibels_of_mean,
         nullptr,
         {},
         first_layer,
         decibels},
    };
}
