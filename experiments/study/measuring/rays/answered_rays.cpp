#include "experiments/study/measuring/rays/answered_rays.h"

#include "core/files.h"
#include "metrics/tone_map.h"
#include "variants/common/halton.h"
#include "variants/tracers/outcome.h"

#include <algorithm>
#include <cmath>

namespace {

using Frame = AnsweredRays::Frame;

constexpr float mirror_roughness = 0.05f;  // perceptual; a lobe as narrow shows about one point

glm::vec3 shown(const Frame& frame, size_t pixel, glm::uvec2 end, float confidence) {
    const glm::uvec2 inside = glm::min(end, frame.lit.extent - 1u);
    return glm::mix(frame.fallback.rgb(pixel), frame.lit.rgb(size_t(inside.y) * frame.lit.extent.x + inside.x),
                    confidence);
}

glm::vec3 shown(const Frame& frame, size_t pixel, const RayRecord& march) {
    return march.confidence > 0 ? shown(frame, pixel, march.pixel, march.confidence) : frame.fallback.rgb(pixel);
}

glm::vec3 shown(const Frame& frame, size_t pixel, const ExactHit& exact) {
    if (exact.outcome != outcome_hit) return frame.fallback.rgb(pixel);
    return shown(frame, pixel, glm::uvec2(glm::max(exact.position, 0.0f)), 1);
}

float square(glm::vec3 v) { return glm::dot(v, v); }

/// By an answer, of the squared error of the ray's pixel. In a mirror the pixel's truth is the ray's. On a rough
/// surface the ray is one of many: what it meets is the answer, if the screen or the sky shows it, and where neither
/// does the fallback takes its place, which may be farther from the truth than what the march found.
float error_removed(const Frame& frame, size_t pixel, const RayRecord& march, const ExactHit& exact) {
    const glm::vec3 reflectance = frame.reflectance.values.empty() ? glm::vec3(1) : frame.reflectance.rgb(pixel);
    const glm::vec3 before = reflectance * shown(frame, pixel, march), after = reflectance * shown(frame, pixel, exact);
    const bool is_shown = exact.outcome == outcome_hit || exact.outcome == outcome_background;
    const bool is_mirror = frame.normal.values[4 * pixel + 3] <= mirror_roughness;
    if (frame.true_specular.values.empty() || (is_shown && !is_mirror)) return square(before - after);
    const glm::vec3 truth = frame.true_specular.rgb(pixel);
    return square(before - truth) - square(after - truth);
}

/// For each traced ray the variance of the luminances that it and its neighbours show, the rays of the same number
/// around: of 3x3 pixels, or, where those trace no other ray (one in 2x2 pixels, one in a tile), of the smallest square
/// of twice, four times... the reach that does.
std::vector<float> variances(const Frame& frame, const RecordedRays& marched) {
    const glm::ivec2 extent(frame.lit.extent);
    const unsigned per_pixel = marched.rays_per_pixel;
    std::vector<float> luminances(marched.rays.size()), result(marched.rays.size());
    for (size_t i = 0; i < luminances.size(); ++i)
        if (marched.rays[i].is_traced > 0) {
            const glm::vec3 color = shown(frame, i / per_pixel, marched.rays[i]);
            luminances[i] = float(luminance(color.r, color.g, color.b));
        }
    for (size_t i = 0; i < result.size(); ++i) {
        if (marched.rays[i].is_traced == 0) continue;
        const glm::ivec2 pixel(int(i / per_pixel) % extent.x, int(i / per_pixel) / extent.x);
        double count = 0, sum = 0, squares = 0;
        for (int reach = 1; reach <= 8 && count < 2; reach *= 2) {
            count = sum = squares = 0;
            const glm::ivec2 first = glm::max(pixel - reach, 0), last = glm::min(pixel + reach, extent - 1);
            for (int y = first.y; y <= last.y; ++y)
                for (int x = first.x; x <= last.x; ++x) {
                    const size_t near = size_t(y * extent.x + x) * per_pixel + i % per_pixel;
                    if (marched.rays[near].is_traced == 0) continue;
                    count += 1, sum += luminances[near], squares += double(luminances[near]) * luminances[near];
                }
        }
        result[i] = float(squares / count - sum / count * (sum / count));
    }
    return result;
}

/// Rays with the largest come first.
std::vector<float> scores(const Frame& frame, const RecordedRays& marched, const std::vector<ExactHit>& exact,
                          const std::string& selector) {
    if (selector == "variance") return variances(frame, marched);
    std::vector<float> result(marched.rays.size());
    for (size_t i = 0; i < result.size(); ++i) {
        const RayRecord& march = marched.rays[i];
        if (march.is_traced == 0) continue;
        if (selector == "confidence") result[i] = 1 - march.confidence;
        if (selector == "oracle") result[i] = error_removed(frame, i / marched.rays_per_pixel, march, exact[i]);
        if (!std::isfinite(result[i])) result[i] = 0;
    }
    return result;
}

uint32_t hash_of(const std::string& text) {
    ContentHash hash;
    hash.add(text);
    return uint32_t(std::stoul(hash.hex().substr(0, 8), nullptr, 16));
}

}  // namespace

std::vector<ExactHit> AnsweredRays::choose(const RecordedRays& marched, const std::vector<ExactHit>& exact,
                                           const AskedRays& asked) const {
    const std::vector<float> score = scores(frame_, marched, exact, asked.selector);
    // Equal rays are put into a random order, so that the choice among them favours no part of the image.
    const uint32_t pass = hash_of(marched.stage);
    std::vector<uint32_t> order(marched.rays.size());
    std::vector<size_t> rays;
    for (size_t i = 0; i < marched.rays.size(); ++i) {
        if (marched.rays[i].is_traced == 0) continue;
        rays.push_back(i);
        order[i] = pcg4d({uint32_t(i), frame_.index, frame_.seed, pass}).x;
    }
    const auto is_first = [&](size_t a, size_t b) {
        return std::tuple(-score[a], order[a], a) < std::tuple(-score[b], order[b], b);
    };
    const auto count = std::ptrdiff_t(std::lround(asked.share * double(rays.size())));
    std::nth_element(rays.begin(), rays.begin() + count, rays.end(), is_first);
    std::vector<ExactHit> answers(exact.size(), ExactHit{.outcome = outcome_unanswered});
    for (auto ray = rays.begin(); ray != rays.begin() + count; ++ray) answers[*ray] = exact[*ray];
    return answers;
}
