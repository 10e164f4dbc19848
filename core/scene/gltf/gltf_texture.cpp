#include "core/scene/gltf/gltf_texture.h"

#include "core/error.h"
#include "core/jpeg.h"
#include "core/near_miss.h"
#include "core/png.h"
#include "core/scene/gltf/encoded_image.h"
#include "core/scene/gltf/gltf_value.h"
#include "core/scene/ranges.h"

#include <tbb/parallel_for.h>
#include <algorithm>
#include <cmath>

namespace {
TextureWrap wrap(const GltfFile& file, int mode) {
    switch (mode) {
        case TINYGLTF_TEXTURE_WRAP_REPEAT:
            return TextureWrap::repeat;
        case TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT:
            return TextureWrap::mirrored_repeat;
        case TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE:
            return TextureWrap::clamp_to_edge;
        default:
            fail(file.name(), ": a sampler has the unknown wrap mode ", mode);
    }
}

/// KHR_texture_transform: uv' = translation * rotation * scale * uv, the rotation counter-clockwise where v points up.
glm::mat3 texture_transform(const GltfFile& file, const tinygltf::Value& extension, const std::string& what) {
    const glm::vec2 offset = vec2_member(file, extension, "offset", glm::vec2(0.0f), what);
    const glm::vec2 scale = vec2_member(file, extension, "scale", glm::vec2(1.0f), what);
    const float rotation = number_member(file, extension, "rotation", 0.0f, what);
    for (int i = 0; i < 2; ++i) {
        checked_number(file, offset[i], -any_length, any_length, what + ": 'offset'");
        checked_number(file, scale[i], -any_length, any_length, what + ": 'scale'");
    }
    const float c = std::cos(rotation), s = std::sin(rotation);
    return glm::mat3(c * scale.x, -s * scale.x, 0.0f, s * scale.y, c * scale.y, 0.0f, offset.x, offset.y, 1.0f);
}

struct Decoded {
    glm::uvec2 extent{0, 0};
    Texels rgba;
};

/// Only PNG and JPEG, as glTF 2.0 has it, by libpng and libjpeg-turbo: Debian's stb_image, which tinygltf calls,
/// inflates a few bytes to gigabytes without a look at the header, and writes outside its memory for some broken JPEGs.
/// What stays is taken from `kept`.
Decoded decode_image(const GltfFile& file, size_t index, MemoryShare& kept) {
    const tinygltf::Image& encoded = file.model.images[index];
    const std::string name = encoded.uri.empty() ? encoded.name : encoded.uri,
                      what = file.name() + ": image " + std::to_string(index) + " ('" + shortened(name) + "')";
    const auto broken = [&] { fail(what, " cannot be decoded: it is neither an intact PNG nor JPEG"); };
    const glm::uvec2 extent = encoded_extent(encoded.image);
    if (extent.x == 0 || extent.y == 0) broken();
    if (std::max(extent.x, extent.y) > any_texture_side)
        fail(what, " has ", extent.x, " x ", extent.y, " pixels; allowed are sides of ", any_texture_side);
    // Per pixel: of RGBA, and what is there beside it: 16-bit codes of a PNG; planes, coefficients and a copy of a
    // JPEG.
    constexpr double bytes_kept = 4, bytes_of_png = 8, bytes_of_jpeg = 14;
    const double bytes_of_decoder = is_png(encoded.image) ? bytes_of_png : bytes_of_jpeg;
    const double pixels = double(extent.x) * double(extent.y);
    const std::string sized = what + " of " + std::to_string(extent.x) + " x " + std::to_string(extent.y) + " pixels";
    MemoryShare decoder;
    kept.add(pixels * bytes_kept, sized), decoder.add(pixels * bytes_of_decoder, sized);

    auto rgba = is_png(encoded.image) ? decode_png_rgba(encoded.image) : decode_jpeg_rgba(encoded.image, extent);
    if (!rgba) broken();
    return {extent, make_texels(std::move(*rgba))};
}
}  // namespace

TextureSlot GltfTextures::slot(int texture, int texcoord, const tinygltf::ExtensionMap& extensions, bool is_srgb,
                               const std::string& what) {
    TextureSlot slot;
    if (texture < 0) return slot;
    const auto& model = file_.model;
    const auto& source = model.textures[checked_index(file_, texture, model.textures.size(), what + ": texture")];
    if (source.source < 0) {
        file_.warn("The " + what + " is ignored, since its image is of a kind that ssrlab cannot decode.");
        return slot;
    }
    if (texcoord < 0) fail(file_.name(), ": the ", what, " has the negative texCoord ", texcoord);
    slot.texcoord = unsigned(texcoord);
    if (const auto found = extensions.find("KHR_texture_transform"); found != extensions.end()) {
        slot.uv_transform = texture_transform(file_, found->second, what);
        const int replacement = index_member(file_, found->second, "texCoord", what);
        if (replacement >= 0) slot.texcoord = unsigned(replacement);
    }
    if (slot.texcoord > 1) {
        file_.warn("The " + what + " uses the texture coordinates TEXCOORD_" +
                              std::to_string(slot.texcoord) + ", which are replaced by TEXCOORD_0.");
        slot.texcoord = 0;
    }
    const auto [found, is_new] = index_of_.try_emplace({texture, is_srgb}, int(scene_.textures.size()));
    slot.texture = found->second;
    if (!is_new) return slot;

    Texture& added = scene_.textures.emplace_back();
    image_of_.push_back(checked_index(file_, source.source, model.images.size(), what + ": image"));
    const tinygltf::Image& image = model.images[image_of_.back()];
    added.name = !image.uri.empty() && !tinygltf::IsDataURI(image.uri) ? image.uri : image.name;
    added.is_srgb = is_srgb;
    if (source.sampler >= 0) {
        const auto& sampler =
            model.samplers[checked_index(file_, source.sampler, model.samplers.size(), what + ": sampler")];
        added.wrap_u = wrap(file_, sampler.wrapS);
        added.wrap_v = wrap(file_, sampler.wrapT);
        added.is_nearest = sampler.magFilter == TINYGLTF_TEXTURE_FILTER_NEAREST;
    }
    return slot;
}

void GltfTextures::decode() {
    std::vector<size_t> images(image_of_);
    std::ranges::sort(images);
    images.erase(std::unique(images.begin(), images.end()), images.end());
    std::vector<Decoded> decoded(file_.model.images.size());
    tbb::parallel_for(size_t(0), images.size(),
                      [&](size_t i) { decoded[images[i]] = decode_image(file_, images[i], scene_.memory); });
    for (size_t i = 0; i < scene_.textures.size(); ++i) {
        const Decoded& image = decoded[image_of_[i]];
        scene_.textures[i].extent = image.extent, scene_.textures[i].rgba = image.rgba;
    }
}
