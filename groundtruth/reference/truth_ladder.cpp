#include "groundtruth/reference/truth_ladder.h"

#include <cmath>

namespace {

HostImage product(const HostImage& a, const HostImage& b) {
    HostImage result = a;
    for (size_t i = 0; i < result.values.size(); ++i) result.values[i] *= b.values[i];
    return result;
}

double channel_mean(glm::dvec3 v) { return (v.x + v.y + v.z) / 3; }

}  // namespace

ReferenceOutput reflected(const Reference& reference, const ReferenceOutput& incident) {
    const HostImage& r = reference.ladder.reflectance;
    return {product(incident.mean, r), product(incident.half_a, r), product(incident.half_b, r),
            product(product(incident.variance, r), r)};
}

LadderDifference ladder_difference(const ReferenceOutput& upper, const ReferenceOutput& lower,
                                   std::span<const uint8_t> inside) {
    double mean = 0, square = 0, mean_variance = 0, square_variance = 0;
    size_t pixels = 0;
    for (size_t i = 0; i < upper.mean.pixel_count(); ++i) {
        if (!inside[i]) continue;
        // The differences a, b of both halves are independent. With the true difference d and the covariances C of a
        // half's channels, a b has mean d d and, if noise is normal, variance sum of 2 d d C + C C; (a a - b b)^2 / 4
        // has that mean.
        const glm::dvec3 a = glm::dvec3(lower.half_a.rgb(i)) - glm::dvec3(upper.half_a.rgb(i));
        const glm::dvec3 b = glm::dvec3(lower.half_b.rgb(i)) - glm::dvec3(upper.half_b.rgb(i));
        mean += 0.5 * channel_mean(a + b);
        mean_variance += std::pow(0.5 * channel_mean(a - b), 2);
        square += channel_mean(a * b);
        square_variance += std::pow(0.5 * channel_mean(a * a - b * b), 2);
        ++pixels;
    }
    if (pixels == 0) return {};
    const double n = double(pixels);
    return {mean / n, std::sqrt(mean_variance) / n, square / n, std::sqrt(square_variance) / n};
}

LadderSummary summarize_ladder(const Reference& reference, std::span<const uint8_t> inside) {
    LadderSummary summary;
    std::vector<uint8_t> counts(reference.specular.mean.pixel_count());
    for (size_t i = 0; i < counts.size(); ++i) {
        counts[i] = reference.ladder.reflectance.rgb(i) != glm::vec3(0.0f) && (inside.empty() || inside[i]);
        if (!counts[i]) continue;
        ++summary.pixels;
        summary.mean_specular += channel_mean(reference.specular.mean.rgb(i));
        summary.on_screen_share += reference.ladder.on_screen_share.values[i];
    }
    if (summary.pixels == 0) return summary;
    summary.mean_specular /= double(summary.pixels);
    summary.on_screen_share /= double(summary.pixels);

    const ReferenceOutput rungs[] = {reflected(reference, reference.incident),
                                     reflected(reference, reference.ladder.camera_radiance),
                                     reflected(reference, reference.ladder.on_screen)};
    const char* names[] = {"split_sum", "camera_radiance", "on_screen"};
    const char* costs[] = {"factors in place of the BRDF", "one view and one bounce", "what the screen does not show"};
    for (int i = 0; i < 3; ++i) {
        const ReferenceOutput& above = i == 0 ? reference.specular : rungs[i - 1];
        summary.rungs.push_back({names[i], costs[i], ladder_difference(above, rungs[i], counts),
                                 ladder_difference(reference.specular, rungs[i], counts)});
    }
    return summary;
}
