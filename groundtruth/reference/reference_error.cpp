#include "groundtruth/reference/reference_error.h"

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
