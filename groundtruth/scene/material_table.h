#pragma once
#include "core/scene/scene.h"
#include "core/shared/brdf.h"
#include "groundtruth/scene/embree_scene.h"
#include "groundtruth/scene/texture_lookup.h"

#include <vector>

/// A point with its evaluated material: the same quantities as a pixel of the G-buffer.
struct ShadedPoint {
    glm::vec3 position, error;  ///< m; see SurfacePoint
    glm::vec3
        origin;  ///< m; origin of rays that leave the point, from step_back(); offset_origin() still has to move it
    glm::vec3 geometric_normal;  ///< unit, on the viewer's side
    glm::vec3 normal;            ///< shading normal, of any length; see unit_normal()
    glm::vec3 base_color;
    float metalness = 0, roughness = 0, specular = 0;
    glm::vec3 dielectric_f0{usual_dielectric_f0};  ///< see specular_f0()
    glm::vec3 emitted;                             ///< radiance towards the viewer (W sr^-1 m^-2)
    bool is_unlit = false;
};

/// Evaluates glTF materials at hits. Emission leaves the front side only, unless the material is double-sided
/// (glTF 2.0, section 3.9.6: what is not double-sided has no back side to see).
class MaterialTable {
public:
    MaterialTable(const Scene& scene, const EmbreeScene& geometry, bool evaluate_everything);

    /// Calls take(ShadedPoint): inlined, so that the point stays in registers. `view` (unit) points from the surface to
    /// the viewer, which is `distance` (m) away.
    template <class Take>
    void shade(uint32_t instance, uint32_t triangle, float u, float v, glm::vec3 view, float distance,
               const Take& take) const;

    /// Both prefetch data of a textured surface for shade(): first the corners, then the texels that the corners lead
    /// to.
    void prefetch_corners(uint32_t instance, uint32_t triangle) const;
    void prefetch_texels(uint32_t instance, uint32_t triangle, float u, float v) const;

    /// Radiance (W sr^-1 m^-2) that the material emits at barycentrics (u, v), on a side that emits; 0 where a mask
    /// cuts the surface out.
    glm::vec3 emission(uint32_t instance, uint32_t triangle, float u, float v) const;

    /// The upper bound of emission(), unless vertex colours exceed 1.
    glm::vec3 greatest_emission(uint32_t material) const { return constants_[material].surface.emitted; }

    bool emits(uint32_t material) const { return constants_[material].emits; }
    bool emission_varies(uint32_t material) const { return constants_[material].emission_varies; }

    /// Whether any material has textures or vertex colours.
    bool any_varies() const { return any_varies_; }

    /// Whether ShadedPoint::dielectric_f0 is ever different from 0.04.
    bool any_dielectric_f0() const { return any_dielectric_f0_; }

private:
    struct Constants {
        ShadedPoint
            surface;  ///< base colour, metalness, roughness, reflectances and emission, if no texture varies them
        bool varies, emission_varies, emits, emits_behind;
    };
    struct Corners {
        const Vertex* vertex[3];
        float weight[3];
        glm::vec2 uv(const TextureSlot& slot) const;
        glm::vec4 color() const;
    };
    Corners corners(uint32_t instance, uint32_t triangle, float u, float v) const;
    glm::vec4 sample(const TextureSlot& slot, const Corners& corners) const;
    static ShadedPoint facing(const SurfacePoint& surface, const ShadedPoint& properties, bool emits_behind,
                              glm::vec3 view, float distance);
    ShadedPoint shade_varying(SurfacePoint surface, uint32_t instance, uint32_t triangle, float u, float v,
                              glm::vec3 view, float distance) const;
    ShadedPoint properties(const Material& material, const Corners& corners) const;
    glm::vec3 mapped_normal(const Material& material, const Corners& corners, const InstanceRecord& instance,
                            glm::vec3 normal) const;

    const Scene& scene_;
    const EmbreeScene& geometry_;
    TiledTextures textures_;
    std::vector<Constants> constants_;
    bool any_varies_ = false, any_dielectric_f0_ = false;
};

/// Completes the properties of a material to those of a point, turned to the viewer.
inline ShadedPoint MaterialTable::facing(const SurfacePoint& surface, const ShadedPoint& properties, bool emits_behind,
                                         glm::vec3 view, float distance) {
    const bool is_behind = glm::dot(surface.front_normal, view) < 0;
    const float side = is_behind ? -1.0f : 1.0f;
    const bool is_dark = is_behind && !emits_behind;
    return {surface.position,
            surface.error,
            step_back(surface.position, surface.error, view, distance),
            side * surface.front_normal,
            side * surface.normal,
            properties.base_color,
            properties.metalness,
            properties.roughness,
            properties.specular,
            properties.dielectric_f0,
            is_dark ? glm::vec3(0.0f) : properties.emitted,
            properties.is_unlit};
}

template <class Take>
inline void MaterialTable::shade(uint32_t instance_index, uint32_t triangle, float u, float v, glm::vec3 view,
                                 float distance, const Take& take) const {
    const InstanceRecord& instance = geometry_.instance(instance_index);
    const Constants& constants = constants_[instance.material];
    const SurfacePoint surface = geometry_.point(instance_index, triangle, u, v);
    if (constants.varies)
        take(shade_varying(surface, instance_index, triangle, u, v, view, distance));
    else
        take(facing(surface, constants.surface, constants.emits_behind, view, distance));
}
