#include "metrics/masks.h"

#include "core/error.h"
#include "core/near_miss.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace {

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

bool reflects(const MaskInputs& in, glm::uvec2 p) {
    const float* reflectance = in.reflectance.pixel(p.x, p.y);
    return *in.material_id.pixel(p.x, p.y) != 0 &&
           *std::max_element(reflectance, reflectance + in.reflectance.channels) >= in.reflective_min_reflectance;
}

bool is_inside(const std::string& name, const MaskInputs& in, glm::uvec2 p) {
    if (name == "all") return true;
    if (name == "edge") return is_edge(in, p);
    const bool is_hit = *in.confidence.pixel(p.x, p.y) >= hit_confidence;
    return reflects(in, p) && *in.roughness.pixel(p.x, p.y) <= in.reflective_max_roughness &&
           (name == "reflective" || is_hit == (name == "hit"));
}

bool is_inside(const RoughnessClass& edges, const MaskInputs& in, glm::uvec2 p) {
    const float roughness = *in.roughness.pixel(p.x, p.y);
    return reflects(in, p) && roughness >= edges.from &&
           (roughness < edges.below || (roughness == 1 && edges.below == 1));
}

template <class IsInside>
std::vector<uint8_t> inside_pixels(glm::uvec2 extent, const IsInside& is_inside) {
    std::vector<uint8_t> inside;
    inside.reserve(size_t(extent.x) * extent.y);
    for (unsigned y = 0; y < extent.y; ++y)
        for (unsigned x = 0; x < extent.x; ++x) inside.push_back(is_inside(glm::uvec2(x, y)));
    return inside;
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

constexpr std::string_view class_prefix = "roughness_";

/// The number that starts the text, which is cut off; none if it is not a plain decimal in [0, 1].
std::optional<float> take_edge(std::string_view& text) {
    float edge = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), edge, std::chars_format::fixed);
    if (error != std::errc() || !(edge >= 0 && edge <= 1)) return std::nullopt;
    text.remove_prefix(size_t(end - text.data()));
    return edge;
}

std::vector<uint8_t> disoccluded_reflective(const MaskInputs& inputs) {
    std::vector<uint8_t> inside = disoccluded(inputs.view_depth, inputs.normal, inputs.material_id, *inputs.previous);
    const std::vector<uint8_t> reflective =
        inside_pixels(inputs.view_depth.extent, [&](glm::uvec2 p) { return is_inside("reflective", inputs, p); });
    for (size_t i = 0; i < inside.size(); ++i) inside[i] = inside[i] && reflective[i];
    return inside;
}

}  // namespace

std::optional<RoughnessClass> roughness_class(const std::string& name) {
    if (!name.starts_with(class_prefix)) return std::nullopt;
    std::string_view rest = std::string_view(name).substr(class_prefix.size());
    if (const std::optional<float> from = take_edge(rest); from && rest.starts_with('_')) {
        rest.remove_prefix(1);
        if (const std::optional<float> below = take_edge(rest); below && rest.empty() && *from < *below)
            return RoughnessClass{*from, *below};
    }
    fail("the mask '", name, "' is not a class of roughness: allowed are roughness_FROM_BELOW with decimals ",
         "0 <= FROM < BELOW <= 1, such as 'roughness_0.1_0.2'");
}

const std::vector<std::string>& mask_names() {
    static const std::vector<std::string> names = {"all", "reflective", "hit", "miss", "edge", "disoccluded"};
    return names;
}

void check_mask_name(const std::string& name) {
    if (roughness_class(name) || std::ranges::find(mask_names(), name) != mask_names().end()) return;
    std::vector<std::string> known = mask_names();
    known.emplace_back("roughness_FROM_BELOW");
    fail("no mask named '", name, "'", suggestion(name, known));
}

Mask make_mask(const std::string& name, const MaskInputs& inputs) {
    check_mask_name(name);
    check(inputs);
    const glm::uvec2 extent = inputs.view_depth.extent;
    Mask mask{.name = name, .extent = extent, .inside = {}};
    if (const std::optional<RoughnessClass> edges = roughness_class(name))
        mask.inside = inside_pixels(extent, [&](glm::uvec2 p) { return is_inside(*edges, inputs, p); });
    else if (name != "disoccluded")
        mask.inside = inside_pixels(extent, [&](glm::uvec2 p) { return is_inside(name, inputs, p); });
    else if (inputs.previous)
        mask.inside = disoccluded_reflective(inputs);
    else
        mask.inside.assign(size_t(extent.x) * extent.y, 0);
    return mask;
}
