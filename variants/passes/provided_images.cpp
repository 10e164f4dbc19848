#include "variants/passes/provided_images.h"

#include "core/error.h"
#include "variants/common/depth_pyramid.h"

#include <algorithm>

namespace {

const std::map<std::string, Image GBuffer::*> of_gbuffer = {
    {"depth", &GBuffer::depth},
    {"geometric_normal", &GBuffer::geometric_normal},
    {"normal", &GBuffer::normal},
    {"base_color", &GBuffer::base_color},
    {"emission", &GBuffer::emission},
    {"dielectric_f0", &GBuffer::dielectric_f0},
    {"motion", &GBuffer::motion},
    {"material_id", &GBuffer::material_id},
    {"previous_depth", &GBuffer::previous_depth},
    {"previous_normal", &GBuffer::previous_normal},
    {"lit", &GBuffer::lit},
    {"fallback", &GBuffer::fallback},
    {"second_depth", &GBuffer::second_depth},
    {"back_depth", &GBuffer::back_depth},
};

struct Noise {
    NoiseShift shift;
    NoisePrecision precision;
};
const std::map<std::string, Noise> noises = {
    {"blue_noise", {NoiseShift::r2, NoisePrecision::float_32}},
    {"white_noise", {NoiseShift::white, NoisePrecision::float_32}},
    {"golden_noise", {NoiseShift::golden_diagonal, NoisePrecision::bits_8}},
    {"golden_noise_from_half", {NoiseShift::golden_diagonal_from_half, NoisePrecision::bits_8}}};

/// Name to the stage that makes it.
const std::map<std::string, std::string> others = {{"lit_before", "common/keep_lit"},
                                                   {"nearest_depths", "common/depth_pyramid"},
                                                   {"farthest_depths", "common/depth_pyramid"},
                                                   {"noise_table", ""},
                                                   {"blue_noise_texture", ""},
                                                   {"split_sum", ""},
                                                   {"below_horizon", ""},
                                                   {"black", ""}};

}  // namespace

std::vector<std::string> ProvidedImages::names() {
    std::vector<std::string> names;
    for (const auto& [name, member] : of_gbuffer) names.push_back(name);
    for (const auto& [name, stage] : others) names.push_back(name);
    for (const auto& [name, noise] : noises) names.push_back(name);
    return names;
}

bool ProvidedImages::has(const std::string& name) {
    return of_gbuffer.contains(name) || others.contains(name) || noises.contains(name);
}

std::string ProvidedImages::stage_of(const std::string& name) {
    if (noises.contains(name)) return "common/blue_noise";
    const auto found = others.find(name);
    return found == others.end() ? "" : found->second;
}

bool ProvidedImages::is_depth_layer(const std::string& name) { return name == "second_depth" || name == "back_depth"; }

Image ProvidedImages::image(PassList& pass_list, const GBuffer& gbuffer, const std::string& name,
                            const ParameterSet& params, NoiseStage stage) {
    const auto [entry, is_new] = made_.try_emplace(name);
    if (is_new) entry->second = make(pass_list, gbuffer, name, params, stage);
    return entry->second;
}

Image ProvidedImages::make(PassList& pass_list, const GBuffer& gbuffer, const std::string& name,
                           const ParameterSet& params, NoiseStage stage) {
    if (const auto member = of_gbuffer.find(name); member != of_gbuffer.end()) return gbuffer.*member->second;
    if (name == "lit_before") return lit_.previous(pass_list, gbuffer.lit);
    constexpr unsigned all_mips = 32;  // depth_pyramid() makes no more than there are
    if (name == "nearest_depths") return depth_pyramid(pass_list, gbuffer.depth, all_mips, false);
    if (name == "farthest_depths") return depth_pyramid(pass_list, gbuffer.depth, all_mips, true);
    if (const auto noise = noises.find(name); noise != noises.end())
        return noise_.render(pass_list, noise->second.shift, noise->second.precision, stage);
    if (name == "noise_table") return noise_.table(pass_list);
    if (name == "split_sum") return split_sum_.on(pass_list);
    if (name == "below_horizon") return horizon_.on(pass_list, params);
    if (name == "black") return pass_list.image_black_at_first("black", Format::rgba8, {1, 1});
    if (name != "blue_noise_texture") fail("no image '", name, "' is provided");
    const Image texture = pass_list.image_of(name, Format::rgba8, glm::uvec2(blue_noise_texture_width));
    if (uploaded_texture_.lock() != texture.storage) {
        pass_list.upload_rgba8(texture, blue_noise_texture());
        uploaded_texture_ = texture.storage;
    }
    return texture;
}
