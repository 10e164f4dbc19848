#pragma once
#include "core/scene/scene.h"

#include <array>

/// Pointers to the slots that affect the picture, to const ones of a const Material.
template <class AnyMaterial>
auto texture_slots(AnyMaterial& m) {
    return std::array{&m.base_color_texture, &m.metalness_roughness_texture, &m.normal_texture, &m.emission_texture,
                      &m.specular_texture,   &m.specular_color_texture};
}

/// The names of these slots in messages, in the same order.
inline constexpr std::array texture_channels = {"base colour", "metallic-roughness", "normal",
                                                "emissive",    "specular",           "specular colour"};

/// Whether the reflectance of the dielectric at normal incidence is other than 0.04 for all colours, somewhere on the
/// material.
inline bool has_own_dielectric_f0(const Material& m) {
    return m.dielectric_f0 != 0.04f || m.specular_color != glm::vec3(1.0f) || m.specular_color_texture.texture >= 0;
}
