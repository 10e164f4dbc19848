#include "groundtruth/reference/adaptive_directions.h"

#include "groundtruth/reference/reference_guide.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace {

/// The guide has few samples. A pixel's own deviation alone misses bright paths that the guide did not meet, and wide
/// windows alone spread the directions of a thin reflection. Means of deviations, not of variances: one bright path in
/// the guide would else take the budget of its whole window.
struct Window {
    int radius;  ///< pixels
    double weight;
};
constexpr Window windows[] = {{0, 0.25}, {1, 0.25}, {3, 0.5}};

constexpr double most_directions = 64;  ///< keeps a wrong estimate affordable

/// A pixel darker than this share of the image's mean counts as if it were so bright: else a few black ones would take
/// all.
constexpr double floor_share = 0.1;

double mean_of(glm::vec3 rgb) { return glm::dot(rgb, glm::vec3(1.0f / 3)); }

/// Of `values` (one channel), over the pixels with a surface.
double mean_in_window(const HostImage& values, const HostImage& material_id, glm::ivec2 at, int radius) {
    const glm::ivec2 extent(values.extent);
    double sum = 0, count = 0;
    for (int y = std::max(at.y - radius, 0); y <= std::min(at.y + radius, extent.y - 1); ++y)
        for (int x = std::max(at.x - radius, 0); x <= std::min(at.x + radius, extent.x - 1); ++x)
            if (*material_id.pixel(unsigned(x), unsigned(y)) != 0)
                sum += double(*values.pixel(unsigned(x), unsigned(y))), ++count;
    return count > 0 ? sum / count : 0;
}

/// The squared brightness of each pixel, with a floor; 1 where the floor is 0.
std::vector<double> squared_brightness(const HostImage& image, const HostImage& material_id) {
    std::vector<double> squares(image.pixel_count());
    double sum = 0, surfaces = 0;
    for (size_t i = 0; i < squares.size(); ++i) {
        if (material_id.values[i] == 0) continue;
        sum += mean_of(image.rgb(i)), ++surfaces;
    }
    const double floor = surfaces > 0 ? floor_share * sum / surfaces : 0;
    for (size_t i = 0; i < squares.size(); ++i)
        squares[i] = floor > 0 ? std::pow(std::max(mean_of(image.rgb(i)), floor), 2) : 1.0;
    return squares;
}

/// Of the mean over RGB, from variances over `units`; 0 where there is no surface.
std::vector<double> deviations(const HostImage& guide_variance, const std::vector<double>& units,
                               const HostImage& material_id) {
    HostImage own(guide_variance.extent, 1);
    for (size_t i = 0; i < own.values.size(); ++i)
        own.values[i] = float(std::sqrt(mean_of(guide_variance.rgb(i)) / units[i]));
    std::vector<double> smooth(own.values.size());
    for (unsigned y = 0; y < own.extent.y; ++y)
        for (unsigned x = 0; x < own.extent.x; ++x) {
            if (*material_id.pixel(x, y) == 0) continue;
            for (const auto& [radius, weight] : windows)
                smooth[y * own.extent.x + x] += weight * mean_in_window(own, material_id, {x, y}, radius);
        }
    return smooth;
}

/// Directions of a lobe where `wanted` are best.
unsigned rounded(double wanted) { return std::bit_floor(unsigned(std::clamp(wanted, 1.0, most_directions))); }

}  // namespace

HostImage adaptive_directions(const RenderedGuide& guide, double share, bool for_image) {
    const HostImage& material_id = guide.material_id;
    const size_t pixels = material_id.pixel_count();
    const std::vector<double> units =
        for_image ? squared_brightness(guide.image, material_id) : std::vector<double>(pixels, 1.0);
    const std::vector<double> of_lobes[2] = {
        for_image ? deviations(guide.diffuse_variance, units, material_id) : std::vector<double>(pixels),
        deviations(guide.specular_variance, units, material_id)};
    const auto surfaces = double(std::ranges::count_if(material_id.values, [](float id) { return id != 0; }));
    const double budget = share * surfaces * (for_image ? 2 : 1);
    const double largest = std::max(std::ranges::max(of_lobes[0]), std::ranges::max(of_lobes[1]));
    HostImage directions(material_id.extent, 2, 1.0f);
    if (!(largest > 0) || std::isinf(largest)) return directions;  // variances may be beyond float

    const auto added_at = [&](double per_deviation) {
        double sum = 0;
        for (const std::vector<double>& deviations : of_lobes)
            for (const double d : deviations) sum += rounded(per_deviation * d) - 1;
        return sum;
    };
    constexpr int steps = 48;
    double low = 0, high = most_directions * double(pixels) / largest;
    for (int step = 0; step < steps; ++step) {
        const double middle = 0.5 * (low + high);
        (added_at(middle) <= budget ? low : high) = middle;
    }
    for (size_t i = 0; i < pixels; ++i)
        for (const size_t lobe : {0, 1}) directions.values[2 * i + lobe] = float(rounded(low * of_lobes[lobe][i]));
    return directions;
}

Directions directions_of(const HostImage& all, size_t pixel) {
    if (all.values.empty()) return {};
    return {unsigned(all.values[2 * pixel]), unsigned(all.values[2 * pixel + 1])};
}
