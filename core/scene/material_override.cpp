#include "core/scene/material_override.h"

#include "core/error.h"
#include "core/near_miss.h"
#include "core/scene/ranges.h"

#include <algorithm>
#include <regex>

namespace {

/// The texture without one channel: a copy in which that channel is 1, so that the factor alone counts.
void neutralise_channel(Scene& scene, TextureSlot& slot, size_t channel) {
    if (slot.texture < 0) return;
    Texture copy = scene.textures[size_t(slot.texture)];
    for (size_t i = channel; i < copy.rgba.size(); i += 4) copy.rgba[i] = 255;
    slot.texture = int(scene.textures.size());
    scene.textures.push_back(std::move(copy));
}

glm::vec3 read_color(JsonObject& entry, const std::string& key, float max) {
    const glm::vec3 color = entry.vector(key);
    for (int c = 0; c < 3; ++c)
        if (!(color[c] >= 0.0f && color[c] <= max))
            fail(entry.where(), ": '", key, "' has the part ", color[c], " outside of [0, ", max, "]");
    return color;
}

/// Removes what has the materials, and the warnings about how it would have been drawn.
void hide(Scene& scene, const std::vector<bool>& is_hidden) {
    for (size_t i = 0; i < is_hidden.size(); ++i)
        if (is_hidden[i])
            std::erase_if(scene.warnings, [&](const std::string& warning) {
                return warning.find("material '" + shortened(scene.materials[i].name) + "'") != std::string::npos;
            });
    std::erase_if(scene.instances,
                  [&](const Instance& instance) { return is_hidden[scene.meshes[instance.mesh].material]; });
}

/// Which materials' whole names match the regular expression `material`.
std::vector<bool> matching_materials(JsonObject& entry, const Scene& scene) {
    const std::string pattern = entry.text("material");
    constexpr size_t longest = 1000;  // bytes: std::regex recurses once per character, and a stack ends somewhere
    if (pattern.size() > longest)
        fail(entry.where(), ": 'material' has ", pattern.size(), " characters; allowed are ", longest);
    std::vector<bool> matches;
    try {
        const std::regex expression(pattern);
        for (const Material& m : scene.materials) {
            if (m.name.size() > longest)
                fail(entry.where(), ": 'material' cannot be compared with \"", shortened(m.name), "\", a name of ",
                     m.name.size(), " characters; allowed are ", longest);
            matches.push_back(std::regex_match(m.name, expression));
        }
    } catch (const std::regex_error& e) {
        fail(entry.where(), ": 'material' = \"", shortened(pattern), "\" is no regular expression: ", e.what());
    }
    if (std::ranges::find(matches, true) == matches.end())
        fail(entry.where(), ": no material's whole name matches \"", shortened(pattern), "\"");
    return matches;
}

}  // namespace

void apply_override(JsonObject& entry, Scene& scene) {
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
            neutralise_channel(scene, m.metalness_roughness_texture, has_roughness ? 1 : 2);
        if (has_color)
            m.base_color = color,
            m.base_color_texture = m.alpha_mode == AlphaMode::mask ? m.base_color_texture : TextureSlot{};
        if (has_color && m.base_color_texture.texture >= 0)
            for (size_t c = 0; c < 3; ++c) neutralise_channel(scene, m.base_color_texture, c);
        if (has_emission) m.emission = emission, m.emission_texture = {};
        if (has_specular) m.specular = specular;
        if (drops_normal_map) m.normal_texture = {};
    }
    if (is_hidden) hide(scene, matches);
}
