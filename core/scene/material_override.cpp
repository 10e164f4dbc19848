#include "core/scene/material_override.h"

#include "core/error.h"
#include "core/near_miss.h"
#include "core/scene/ranges.h"

#include <re2/re2.h>
#include <algorithm>

namespace {

/// The texture without one channel: a copy in which that channel is 1, so that the factor alone counts.
void neutralise_channel(Scene& scene, TextureSlot& slot, size_t channel, ChangedTexels& changed) {
    if (slot.texture < 0) return;
    Texture copy = scene.textures[size_t(slot.texture)];
    Texels& texels = changed[{copy.rgba, channel}];
    if (!texels) {
        scene.memory.add(double(copy.rgba->size()),
                         "texture '" + shortened(copy.name) + "', as an override changes it,");
        std::vector<uint8_t> rgba = *copy.rgba;
        const size_t bytes = copy.channel_bytes;
        for (size_t i = channel * bytes; i < rgba.size(); i += 4 * bytes)
            for (size_t k = 0; k < bytes; ++k) rgba[i + k] = 0xFF;
        texels = make_texels(std::move(rgba));
    }
    copy.rgba = texels;
    slot.texture = int(scene.textures.size());
    scene.textures.push_back(std::move(copy));
}

/// Removes what has the materials, and the warnings about how it would have been drawn.
void hide(Scene& scene, const std::vector<bool>& is_hidden) {
    const auto is_about = [&](const SceneWarning& warning, size_t material) {
        if (warning.material >= 0) return size_t(warning.material) == material;
        return warning.text.find("material '" + shortened(scene.materials[material].name) + "'") != std::string::npos;
    };
    for (size_t i = 0; i < is_hidden.size(); ++i)
        if (is_hidden[i]) std::erase_if(scene.warnings, [&](const SceneWarning& w) { return is_about(w, i); });
    std::erase_if(scene.instances,
                  [&](const Instance& instance) { return is_hidden[scene.meshes[instance.mesh].material]; });
}

/// Which materials' whole names match the regular expression `material`. RE2 takes time proportional to the lengths of
/// both, whatever the expression; others can take for ever.
std::vector<bool> matching_materials(JsonObject& entry, const Scene& scene) {
    const std::string pattern = entry.text("material");
    const RE2 expression(pattern, RE2::Quiet);
    if (!expression.ok())
        fail(entry.where(), ": 'material' = \"", shortened(pattern),
             "\" is no regular expression of RE2: ", shortened(expression.error()));
    std::vector<bool> matches;
    for (const Material& m : scene.materials) matches.push_back(RE2::FullMatch(m.name, expression));
    if (std::ranges::find(matches, true) == matches.end())
        fail(entry.where(), ": no material's whole name matches \"", shortened(pattern), "\"");
    return matches;
}

}  // namespace

glm::vec3 read_color(JsonObject& entry, const std::string& key, float max) {
    const glm::vec3 color = entry.vector(key);
    for (int c = 0; c < 3; ++c)
        if (!(color[c] >= 0.0f && color[c] <= max))
            fail(entry.where(), ": '", key, "' has the part ", color[c], " outside of [0, ", max, "]");
    return color;
}

void apply_override(JsonObject& entry, Scene& scene, ChangedTexels& changed) {
    const std::vector<bool> matches = matching_materials(entry, scene);

    const bool is_hidden = entry.boolean("hidden", false), drops_normal_map = entry.boolean("drop_normal_map", false);
    const bool has_roughness = entry.has("roughness"), has_metalness = entry.has("metalness");
    const float roughness = entry.number("roughness", 0.0f, 1.0f, 0.0f),
                metalness = entry.number("metalness", 0.0f, 1.0f, 0.0f);
    const bool has_color = entry.has("base_color"), has_emission = entry.has("emission"),
               has_specular = entry.has("specular");
    const glm::vec3 color = has_color ? read_color(entry, "base_color", 1.0f) : glm::vec3(0.0f),
                    emission = has_emission ? read_color(entry, "emission", any_radiance) : glm::vec3(0.0f);
    const float specular = entry.number("specular", 0.0f, 1.0f, 1.0f);
    entry.finish();

    for (size_t i = 0; i < matches.size(); ++i) {
        if (!matches[i]) continue;
        Material& m = scene.materials[i];
        if (has_roughness) m.roughness = roughness;
        if (has_metalness) m.metalness = metalness;
        if (has_roughness && has_metalness)
            m.metalness_roughness_texture = {};
        else if (has_roughness || has_metalness)
            neutralise_channel(scene, m.metalness_roughness_texture, has_roughness ? 1 : 2, changed);
        if (has_color)
            m.base_color = color,
            m.base_color_texture = m.alpha_mode == AlphaMode::mask ? m.base_color_texture : TextureSlot{};
        if (has_color && m.base_color_texture.texture >= 0)
            for (size_t c = 0; c < 3; ++c) neutralise_channel(scene, m.base_color_texture, c, changed);
        if (has_emission) m.emission = emission, m.emission_texture = {};
        if (has_specular) m.specular = specular, m.specular_texture = {};
        if (drops_normal_map) m.normal_texture = {};
    }
    if (is_hidden) hide(scene, matches);
}
