#include "experiments/study/stability/amplification.h"

#include "core/scene/camera.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace {

/// Of the pixel alone, so that every frame of a case at rest moves alike.
uint32_t hashed(uint32_t x) {
    x ^= x >> 16, x *= 0x7feb352du, x ^= x >> 15, x *= 0x846ca68bu, x ^= x >> 16;
    return x;
}
float sign_at(size_t pixel) { return hashed(uint32_t(pixel)) & 1u ? 1.0f : -1.0f; }

constexpr float normal_step = 1.0f / 32768, color_step = 1.0f / 2048;

/// The next depth that the format can hold, within [0, 1].
float moved_depth(float depth, float sign, DepthFormat format) {
    const float codes = format == DepthFormat::d16 ? 65535.0f : 16777215.0f;
    const float moved =
        format == DepthFormat::d32f ? std::nextafter(depth, sign > 0 ? 2.0f : -1.0f) : depth + sign / codes;
    return std::clamp(moved, 0.0f, 1.0f);
}

void move_depth(HostGBuffer& g) {
    for (size_t i = 0; i < g.depth.values.size(); ++i)
        if (g.material_id.values[i] != 0)
            for (HostImage* image : {&g.depth, &g.previous_depth})
                image->values[i] = moved_depth(image->values[i], sign_at(i), g.depth_format);
}

void move_normal(HostGBuffer& g) {
    for (HostImage* image : {&g.normal, &g.previous_normal})
        for (size_t i = 0; i < image->pixel_count(); ++i) {
            const glm::vec3 n = image->rgb(i);
            if (!(glm::dot(n, n) > 0.5f)) continue;
            const glm::vec3 side = std::abs(n.y) < 0.9f ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0);
            const float turn = 6.2831853f * float(hashed(uint32_t(i) + 77u)) / 4294967296.0f;
            const glm::vec3 u = glm::normalize(glm::cross(side, n)), v = glm::cross(n, u);
            image->set_rgb(i, glm::normalize(n + normal_step * (std::cos(turn) * u + std::sin(turn) * v)));
        }
}

void move_color(HostGBuffer& g) {
    for (size_t i = 0; i < g.lit.pixel_count(); ++i) g.lit.set_rgb(i, g.lit.rgb(i) * (1 + color_step * sign_at(i)));
}

/// As a share of the input.
double relative_step_of(const Perturbation& perturbation, const HostGBuffer& g, size_t pixel) {
    if (perturbation.relative_step > 0) return perturbation.relative_step;
    const float depth = g.depth.values[pixel];
    const double here = view_distance(g.camera, depth),
                 there = view_distance(g.camera, moved_depth(depth, sign_at(pixel), g.depth_format));
    return std::max(std::abs(there - here) / here, double(std::numeric_limits<float>::epsilon()) / 2);
}

}  // namespace

double quantile(std::vector<double>& values, double share) {
    const size_t rank = std::min(values.size() - 1, size_t(std::ceil(share * double(values.size() - 1))));
    std::nth_element(values.begin(), values.begin() + ptrdiff_t(rank), values.end());
    return values[rank];
}

const std::vector<Perturbation>& perturbations() {
    using Row = StabilityRow;
    static const std::vector<Perturbation> all = {{&Row::depth_median, &Row::depth_p999, move_depth},
                                                  {&Row::normal_median, &Row::normal_p999, move_normal, normal_step},
                                                  {&Row::lit_median, &Row::lit_p999, move_color, color_step}};
    return all;
}

void measure_amplification(StabilityRow& row, const Perturbation& perturbation, const CaseFrames& frames,
                           const CaseResult& run, const CaseResult& perturbed) {
    const double magnitude = run.means.back();
    std::vector<double> ratios;
    for (size_t i = 0; i < run.specular.pixel_count(); ++i) {
        if (!frames.is_judged[i]) continue;
        const glm::vec3 change = perturbed.specular.rgb(i) - run.specular.rgb(i);
        const double relative = double(glm::length(change)) / (std::sqrt(3.0) * std::max(magnitude, 1e-30));
        if (std::isfinite(relative))
            ratios.push_back(relative / relative_step_of(perturbation, *frames.steps.back().host, i));
    }
    row.*perturbation.median = ratios.empty() ? 0.0 : quantile(ratios, 0.5);
    row.*perturbation.p999 = ratios.empty() ? 0.0 : quantile(ratios, 0.999);
}
