#include "variants/passes/provided_images.h"

#include "core/error.h"
#include "core/gbuffer/gbuffer_images.h"
#include "variants/common/depth_pyramid.h"

#include <algorithm>

namespace {

const GBufferImage* of_gbuffer(const std::string& name) {
    const auto found = std::ranges::find(gbuffer_images(), name, &GBufferImage::name);
    return found == gbuffer_images().end() ? nullptr : &*found;
}

struct Noise {
    const char* name;
    NoiseShift shift;
    NoisePrecision precision;
    const char* meaning;
};
constexpr Noise noises[] = {
    {"blue_noise", NoiseShift::r2, NoisePrecision::float_32,
     "128x128 texels of two numbers in [0, 1), blue over the image; others in each frame, along the R2 sequence"},
    {"white_noise", NoiseShift::white, NoisePrecision::float_32,
     "128x128 texels of two numbers in [0, 1), independent in every texel and frame"},
    {"golden_noise", NoiseShift::golden_diagonal, NoisePrecision::bits_8,
     "as `blue_noise`, in [0, 1] and in steps of the golden ratio, as AMD FidelityFX SSSR 1.5 has them"},
    {"golden_noise_from_half", NoiseShift::golden_diagonal_from_half, NoisePrecision::bits_8,
     "as `golden_noise`, 1/2 later, as DiligentFX has them"}};

struct Other {
    const char *name, *stage;  ///< the stage that makes it; "": none
    const char *format, *meaning;
};
constexpr Other others[] = {
    {"lit_before", "common/keep_lit", "rgba32f", "`lit` of the previous frame; in the first frame this frame's"},
    {"nearest_depths", "common/depth_pyramid", "r32f",
     "`depth` and all its mips; each texel is the nearest depth of the texels below it"},
    {"farthest_depths", "common/depth_pyramid", "r32f", "the same with the farthest depths"},
    {"split_sum", "", "rg32f",
     "64x64 texels: factors A, B of the lobe's albedo F0 A + F90 B; column: cosine of the viewer, row: roughness"},
    {"below_horizon", "", "r32f",
     "share of the samples below the horizon, for the parameters `lobe` and `importance_bias`; columns and rows as of "
     "`split_sum`"},
    {"noise_table", "", "rg8", "128x128 codes from which the noises are made, under the name `blue_noise`"},
    {"blue_noise_texture", "", "rgba8", "64x64 texels with blue noise in each channel, the same in each frame"},
    {"black", "", "rgba8", "one texel of 0, for images that a shader declares and does not read"}};

template <class Table>
auto entry_of(const Table& table, const std::string& name) {
    const auto found = std::ranges::find_if(table, [&](const auto& entry) { return entry.name == name; });
    return found == std::end(table) ? nullptr : &*found;
}

}  // namespace

std::vector<std::string> ProvidedImages::names() {
    std::vector<std::string> names;
    for (const GBufferImage& image : gbuffer_images()) names.push_back(image.name);
    for (const ProvidedImage& image : described()) names.push_back(image.name);
    return names;
}

std::vector<ProvidedImage> ProvidedImages::described() {
    std::vector<ProvidedImage> all;
    for (const Other& other : others) all.push_back({other.name, other.format, other.meaning});
    for (const Noise& noise : noises)
        all.push_back({noise.name, noise.precision == NoisePrecision::float_32 ? "rg32f" : "rg8", noise.meaning});
    return all;
}

bool ProvidedImages::has(const std::string& name) {
    return of_gbuffer(name) || entry_of(others, name) || entry_of(noises, name);
}

std::string ProvidedImages::stage_of(const std::string& name) {
    if (entry_of(noises, name)) return "common/blue_noise";
    const Other* found = entry_of(others, name);
    return found ? found->stage : "";
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
    if (const GBufferImage* image = of_gbuffer(name)) return gbuffer.*image->image;
    if (name == "lit_before") return lit_.previous(pass_list, gbuffer.lit);
    constexpr unsigned all_mips = 32;  // depth_pyramid() makes no more than there are
    if (name == "nearest_depths") return depth_pyramid(pass_list, gbuffer.depth, all_mips, false);
    if (name == "farthest_depths") return depth_pyramid(pass_list, gbuffer.depth, all_mips, true);
    if (const Noise* noise = entry_of(noises, name))
        return noise_.render(pass_list, noise->shift, noise->precision, stage);
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
