#include "metrics/masks.h"

#include "core/error.h"
#include "core/near_miss.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace {

constexpr float cos_normal_step = 0.9396926f;  // of 20 degrees
constexpr float relative_depth_step = 0.02f;
constexpr float hit_confidence = 0.5f;

float inverse_depth(float view_depth) { return view_depth > 0 ? 1 / view_depth : 0.0f; }  // 0 for Inf, too

bool differs(const MaskInputs& in, glm::uvec2 p, glm::uvec2 q) {
    const float id = *in.material_id.pixel(p.x, p.y);
    if (id != *in.material_id.pixel(q.x, q.y)) return true;
    if (id == 0) return false;
    const float* a = in.normal.pixel(p.x, p.y);
    const float* b = in.normal.pixel(q.x, q.y);
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] < cos_normal_step;
}

/// The second difference of 1/depth over q, p and the pixel opposite to q.
bool depth_jumps(const MaskInputs& in, glm::uvec2 q, glm::uvec2 p, glm::uvec2 opposite) {
    const auto at = [&](glm::uvec2 i) { return inverse_depth(*in.view_depth.pixel(i.x, i.y)); };
    const float before = at(q), here = at(p), after = at(opposite);
    return std::abs(before - 2 * here + after) > relative_depth_step * std::max({before, here, after});
}

bool is_edge(const MaskInputs& in, glm::uvec2 p) {
    const glm::ivec2 extent(in.view_depth.extent);
    const auto inside = [&](glm::ivec2 q) { return q.x >= 0 && q.y >= 0 && q.x < extent.x && q.y < extent.y; };
    constexpr std::array<glm::ivec2, 4> directions = {{{1, 0}, {0, 1}, {1, 1}, {1, -1}}};
    for (const glm::ivec2 step : directions) {
        const glm::ivec2 ahead = glm::ivec2(p) + step, behind = glm::ivec2(p) - step;
        if (inside(ahead) && differs(in, p, ahead)) return true;
        if (inside(behind) && differs(in, p, behind)) return true;
        if (inside(ahead) && inside(behind) && depth_jumps(in, behind, p, ahead)) return true;
    }
    return false;
}

bool is_reflective(const MaskInputs& in, glm::uvec2 p) {
    const float* reflectance = in.reflectance.pixel(p.x, p.y);
    return *in.material_id.pixel(p.x, p.y) != 0 && *in.roughness.pixel(p.x, p.y) <= in.reflective_max_roughness &&
           *std::max_element(reflectance, reflectance + in.reflectance.channels) >= in.reflective_min_reflectance;
}

bool is_inside(const std::string& name, const MaskInputs& in, glm::uvec2 p) {
    if (name == "all") return true;
    if (name == "edge") return is_edge(in, p);
    const bool is_hit = *in.confidence.pixel(p.x, p.y) >= hit_confidence;
    return is_reflective(in, p) && (name == "reflective" || is_hit == (name == "hit"));
}

void check(const MaskInputs& in) {
    const auto require = [&](const HostImage& image, unsigned channels, const char* what) {
        if (image.extent != in.view_depth.extent)
            fail("masks need images of one size, but ", what, " has ", image.extent.x, "x", image.extent.y,
                 " pixels and the depth ", in.view_depth.extent.x, "x", in.view_depth.extent.y);
        if (image.channels < channels) fail("masks need ", channels, " channels of ", what, ", found ", image.channels);
    };
    require(in.view_depth, 1, "the depth");
    require(in.normal, 3, "the normal");
    require(in.material_id, 1, "the material id");
    require(in.roughness, 1, "the roughness");
    require(in.reflectance, 1, "the reflectance");
    require(in.confidence, 1, "the confidence");
}

}  // namespace

const std::vector<std::string>& mask_names() {
    static const std::vector<std::string> names = {"all", "reflective", "hit", "miss", "edge"};
    return names;
}

Mask make_mask(const std::string& name, const MaskInputs& inputs) {
    if (std::ranges::find(mask_names(), name) == mask_names().end())
        fail("no mask named '", name, "'", suggestion(name, mask_names()));
    check(inputs);
    const glm::uvec2 extent = inputs.view_depth.extent;
    Mask mask{.name = name, .extent = extent, .inside = {}};
    mask.inside.reserve(size_t(extent.x) * extent.y);
    for (unsigned y = 0; y < extent.y; ++y)
        for (unsigned x = 0; x < extent.x; ++x) mask.inside.push_back(is_inside(name, inputs, {x, y}));
    return mask;
}
