#include "groundtruth/reference_error.h"

#include "core/error.h"

#include <algorithm>
#include <cmath>

namespace {

double channel_mean(const HostImage& image, size_t pixel) {
    const float* rgb = &image.values[pixel * 3];
    return (double(rgb[0]) + rgb[1] + rgb[2]) / 3;
}

bool is_background(const Reference& reference, size_t pixel) { return reference.material_id.values[pixel] == 0; }

/// By nearest rank: the least value that `share` of all do not exceed.
double percentile(std::vector<float>& values, double share) {
    const size_t rank = std::min(size_t(std::ceil(share * double(values.size()))), values.size());
    const auto nth = values.begin() + ptrdiff_t(rank ? rank - 1 : 0);
    std::ranges::nth_element(values, nth);
    return *nth;
}

struct PixelZ {
    glm::dvec3 z{0.0};
    unsigned channels = 0;  ///< those that have any variance
};

PixelZ half_z(const ReferenceOutput& output, size_t pixel) {
    PixelZ result;
    for (int c = 0; c < 3; ++c) {
        const size_t i = pixel * 3 + size_t(c);
        if (output.variance.values[i] == 0) continue;
        result.z[c] = (double(output.half_a.values[i]) - output.half_b.values[i]) /
                      (2 * std::sqrt(double(output.variance.values[i])));
        ++result.channels;
    }
    return result;
}

}  // namespace

double radiance_floor(const Reference& reference, const ReferenceOutput& output) {
    double sum = 0;
    size_t pixels = 0;
    for (size_t i = 0; i < output.mean.pixel_count(); ++i)
        if (!is_background(reference, i)) sum += channel_mean(output.mean, i), ++pixels;
    return pixels ? relative_error_floor * sum / double(pixels) : 0.0;
}

HostImage relative_error(const Reference& reference, const ReferenceOutput& output) {
    const double floor = radiance_floor(reference, output);
    HostImage error(output.mean.extent, 1);
    for (size_t i = 0; i < error.values.size(); ++i) {
        const double variance = channel_mean(output.variance, i);
        if (variance > 0) error.values[i] = float(std::sqrt(variance) / std::max(channel_mean(output.mean, i), floor));
    }
    return error;
}

float reached_share(const Reference& reference, float target) {
    const HostImage error = relative_error(reference, reference.specular);
    size_t pixels = 0, reached = 0;
    for (size_t i = 0; i < error.values.size(); ++i) {
        if (is_background(reference, i)) continue;
        ++pixels;
        reached += error.values[i] <= target;
    }
    return pixels ? float(double(reached) / double(pixels)) : 1.0f;
}

ErrorSummary relative_error_summary(const Reference& reference, const ReferenceOutput& output,
                                    std::span<const uint8_t> inside) {
    const HostImage error = relative_error(reference, output);
    if (!inside.empty() && inside.size() != error.values.size())
        fail("the mask has ", inside.size(), " pixels, but the reference has ", error.values.size());
    std::vector<float> values;
    double sum = 0;
    for (size_t i = 0; i < error.values.size(); ++i)
        if (inside.empty() ? !is_background(reference, i) : inside[i] != 0) {
            values.push_back(error.values[i]);
            sum += error.values[i];
        }
    if (values.empty()) return {};
    const double mean = sum / double(values.size());
    return {.median = percentile(values, 0.5), .p95 = percentile(values, 0.95), .mean = mean, .pixels = values.size()};
}

HalfAudit audit_halves(const ReferenceOutput& output) {
    const unsigned width = output.mean.extent.x;
    HalfAudit audit;
    double sum = 0, products = 0, left_squares = 0, right_squares = 0;
    for (size_t i = 0; i < output.mean.pixel_count(); ++i) {
        const PixelZ z = half_z(output, i);
        if (z.channels == 0) continue;
        ++audit.pixels;
        sum += glm::dot(z.z, z.z) / z.channels;
        if (i % width + 1 == width) continue;
        const PixelZ right = half_z(output, i + 1);
        products += glm::dot(z.z, right.z);
        left_squares += glm::dot(z.z, z.z);
        right_squares += glm::dot(right.z, right.z);
    }
    if (audit.pixels == 0) return audit;
    audit.mean_z_squared = sum / double(audit.pixels);
    if (left_squares * right_squares > 0) audit.correlation = products / std::sqrt(left_squares * right_squares);
    // F(1, n) has mean n / (n - 2) and variance 2 n^2 (n - 1) / ((n - 2)^2 (n - 4)); here n = 14, and down to mean 1
    // for many passes. The channels of a pixel share their paths, so only pixels count. Three standard deviations: 1 in
    // 370.
    const double deviation = std::sqrt(2.0 * 14 * 14 * 13 / (12 * 12 * 10) / double(audit.pixels));
    audit.low = 1 - 3 * deviation;
    audit.high = 14.0 / 12 + 3 * deviation;
    return audit;
}
