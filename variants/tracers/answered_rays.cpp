#include "variants/tracers/answered_rays.h"

#include "variants/common/halton.h"
#include "variants/tracers/outcome.h"

#include <algorithm>
#include <cmath>
#include <span>

namespace {

/// What a ray shows: the lit colour where it ended, and the fallback as far as it is not sure of that.
class ShownColors {
public:
    ShownColors(PassGraph& graph, const RecordedRays& recorded)
        : recorded_(recorded),
          lit_(graph.download(graph.input("lit"))),
          fallback_(graph.download(graph.input("fallback"))) {}

    glm::vec3 of_march(size_t ray) const {
        const RayRecord& r = recorded_.rays[ray];
        return r.confidence > 0 ? color(ray, r.pixel, r.confidence) : color(ray, {}, 0);
    }
    glm::vec3 of(size_t ray, const ExactHit& exact) const {
        return exact.outcome == outcome_hit ? color(ray, glm::uvec2(glm::max(exact.position, 0.0f)), 1)
                                            : color(ray, {}, 0);
    }

private:
    glm::vec3 color(size_t ray, glm::uvec2 pixel, float confidence) const {
        const glm::uvec2 inside = glm::min(pixel, lit_.extent - 1u);
        const glm::vec3 missed = fallback_.rgb(ray / recorded_.rays_per_pixel),
                        met = lit_.rgb(size_t(inside.y) * lit_.extent.x + inside.x);
        return glm::mix(missed, met, confidence);
    }

    const RecordedRays& recorded_;
    HostImage lit_, fallback_;
};

float square(glm::vec3 v) { return glm::dot(v, v); }

/// By an answer, of the squared error of the ray's pixel. In a mirror the pixel's truth is the ray's. On a rough
/// surface the ray is one of many: what it meets is the answer, if the screen or the sky shows it, and where neither
/// does the fallback takes its place, which may be farther from the truth than what the march found.
float error_removed(glm::vec3 march, glm::vec3 answer, uint32_t outcome, bool is_mirror, size_t pixel,
                    const RayProbe& probe) {
    const glm::vec3 reflectance = probe.reflectance ? probe.reflectance->rgb(pixel) : glm::vec3(1);
    march *= reflectance, answer *= reflectance;
    const bool is_shown = outcome == outcome_hit || outcome == outcome_background;
    if (!probe.true_specular || (is_shown && !is_mirror)) return square(march - answer);
    const glm::vec3 truth = probe.true_specular->rgb(pixel);
    return square(march - truth) - square(answer - truth);
}

float luminance(glm::vec3 color) { return glm::dot(color, glm::vec3(0.2126f, 0.7152f, 0.0722f)); }

/// For each ray the variance of luminance over the traced rays of the same number of the 3x3 pixels around.
std::vector<float> variances(const RecordedRays& recorded, const ShownColors& shown, glm::uvec2 extent) {
    const unsigned per_pixel = recorded.rays_per_pixel;
    std::vector<float> luminances(recorded.rays.size()), result(recorded.rays.size());
    for (size_t i = 0; i < luminances.size(); ++i)
        if (recorded.rays[i].is_traced > 0) luminances[i] = luminance(shown.of_march(i));
    for (size_t i = 0; i < result.size(); ++i) {
        const glm::ivec2 pixel(i / per_pixel % extent.x, i / per_pixel / extent.x);
        const glm::ivec2 first = glm::max(pixel - 1, 0), last = glm::min(pixel + 1, glm::ivec2(extent) - 1);
        double count = 0, sum = 0, squares = 0;
        for (int y = first.y; y <= last.y; ++y)
            for (int x = first.x; x <= last.x; ++x) {
                const size_t near = (size_t(y) * extent.x + size_t(x)) * per_pixel + i % per_pixel;
                if (recorded.rays[near].is_traced == 0) continue;
                count += 1, sum += luminances[near], squares += double(luminances[near]) * luminances[near];
            }
        if (count > 0) result[i] = float(squares / count - sum / count * (sum / count));
    }
    return result;
}

void score_errors(PassGraph& graph, const RecordedRays& recorded, std::span<const size_t> rays,
                  std::span<const ExactHit> exact, const ShownColors& shown, const RayProbe& probe,
                  std::vector<float>& score) {
    constexpr float smoothest_rough = 0.05f;  // perceptual
    const HostImage normal = graph.download(graph.input("normal"));
    for (const size_t i : rays) {
        const size_t pixel = i / recorded.rays_per_pixel;
        const bool is_mirror = normal.values[4 * pixel + 3] < smoothest_rough;
        score[i] = error_removed(shown.of_march(i), shown.of(i, exact[i]), exact[i].outcome, is_mirror, pixel, probe);
    }
}

}  // namespace

std::vector<ExactHit> AnsweredRays::choose(PassGraph& graph, const RecordedRays& recorded, std::vector<ExactHit> exact,
                                           const RayProbe& probe) const {
    std::vector<size_t> rays;
    for (size_t i = 0; i < recorded.rays.size(); ++i)
        if (recorded.rays[i].is_traced > 0) rays.push_back(i);

    std::vector<float> score(recorded.rays.size());
    if (selector_.is("confidence")) {
        for (const size_t i : rays) score[i] = 1 - recorded.rays[i].confidence;
    } else if (!selector_.is("random")) {
        const ShownColors shown(graph, recorded);
        if (selector_.is("variance"))
            score = variances(recorded, shown, graph.extent());
        else
            score_errors(graph, recorded, rays, exact, shown, probe, score);
    }
    for (float& s : score)
        if (!std::isfinite(s)) s = 0;

    // Equal scores are put into a random order, so that the choice among them favours no part of the image.
    std::vector<uint32_t> order(recorded.rays.size());
    for (const size_t i : rays) order[i] = pcg4d({uint32_t(i), probe.frame, probe.seed, 0x5a7eu}).x;
    const auto is_first = [&](size_t a, size_t b) {
        return std::tuple(-score[a], order[a], a) < std::tuple(-score[b], order[b], b);
    };
    const size_t count = size_t(std::lround(double(share_) * double(rays.size())));
    std::nth_element(rays.begin(), rays.begin() + std::ptrdiff_t(count), rays.end(), is_first);
    for (auto ray = rays.begin() + std::ptrdiff_t(count); ray != rays.end(); ++ray)
        exact[*ray].outcome = outcome_unanswered;
    return exact;
}
