#include "groundtruth/reference/adaptive_samples.h"

#include "groundtruth/reference/reference_pixel.h"
#include "groundtruth/reference/reference_stopping.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace {

/// The guide has few samples. A pixel's own variance alone misses bright paths that the guide did not meet, and wide
/// windows alone spread the samples of a thin reflection.
struct Window {
    int radius;  ///< pixels
    double weight;
};
constexpr Window windows[] = {{0, 0.25}, {1, 0.5}, {3, 0.25}};

constexpr double most_growth = 64;  ///< of a pixel's samples: keeps a wrong estimate affordable

/// Of `variance` (one channel), over the pixels with a surface.
double mean_in_window(const HostImage& variance, const HostImage& material_id, glm::ivec2 at, int radius) {
    const glm::ivec2 extent(variance.extent);
    double sum = 0, count = 0;
    for (int y = std::max(at.y - radius, 0); y <= std::min(at.y + radius, extent.y - 1); ++y)
        for (int x = std::max(at.x - radius, 0); x <= std::min(at.x + radius, extent.x - 1); ++x)
            if (*material_id.pixel(unsigned(x), unsigned(y)) != 0)
                sum += double(*variance.pixel(unsigned(x), unsigned(y))), ++count;
    return count > 0 ? sum / count : 0;
}

/// Of the mean over RGB; 0 where there is no surface.
std::vector<double> deviations(const HostImage& guide_variance, const HostImage& material_id) {
    HostImage variance(guide_variance.extent, 1);
    for (size_t i = 0; i < variance.values.size(); ++i)
        variance.values[i] = glm::dot(guide_variance.rgb(i), glm::vec3(1.0f / 3));
    std::vector<double> deviations(variance.values.size());
    for (unsigned y = 0; y < variance.extent.y; ++y)
        for (unsigned x = 0; x < variance.extent.x; ++x) {
            if (*material_id.pixel(x, y) == 0) continue;
            double smooth = 0;
            for (const auto& [radius, weight] : windows)
                smooth += weight * mean_in_window(variance, material_id, {x, y}, radius);
            deviations[y * variance.extent.x + x] = std::sqrt(smooth);
        }
    return deviations;
}

/// What a pixel gets if `wanted` samples are best, in batches of a power of two.
double extra_samples(double wanted, double uniform) {
    const double extra = std::min({wanted, most_growth * uniform, double(max_sample_limit)}) - uniform;
    return extra < batch_count ? 0 : double(batch_count * std::bit_floor(uint64_t(extra / batch_count)));
}

}  // namespace

HostImage adaptive_samples(const HostImage& guide_variance, const HostImage& material_id, uint64_t uniform,
                           double share) {
    const std::vector<double> deviation = deviations(guide_variance, material_id);
    const auto surfaces = double(std::ranges::count_if(material_id.values, [](float id) { return id != 0; }));
    const double budget = share * double(uniform) * surfaces, largest = std::ranges::max(deviation);
    HostImage extra(guide_variance.extent, 1);
    if (!(largest > 0)) return extra;

    const auto sum_at = [&](double samples_per_deviation) {
        double sum = 0;
        for (const double d : deviation) sum += extra_samples(samples_per_deviation * d, double(uniform));
        return sum;
    };
    constexpr int steps = 48;
    double low = 0, high = most_growth * double(uniform) * double(deviation.size()) / largest;
    for (int step = 0; step < steps; ++step) {
        const double middle = 0.5 * (low + high);
        (sum_at(middle) <= budget ? low : high) = middle;
    }
    for (size_t i = 0; i < deviation.size(); ++i)
        extra.values[i] = float(extra_samples(low * deviation[i], double(uniform)));
    return extra;
}
