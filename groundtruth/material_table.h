#pragma once
#include "core/scene/scene.h"
#include "groundtruth/embree_scene.h"

#include <algorithm>
#include <vector>

/// What the path tracer knows of a point once its material is evaluated: the same quantities as a pixel of the G-buffer.
struct ShadedPoint {
    glm::vec3 position, error;     ///< m; see SurfacePoint
    glm::vec3 geometric_normal;    ///< unit, on the viewer's side
    glm::vec3 normal;              ///< unit shading normal
    glm::vec3 base_color;
    float metalness = 0, roughness = 0, specular = 0;
    glm::vec3 emitted;             ///< radiance towards the viewer (W sr^-1 m^-2)
    bool is_unlit = false;
};

/// Evaluates glTF materials at hits. Emission leaves the front side only, unless the material is double-sided (glTF 2.0,
/// section 3.9.6: what is not double-sided has no back side to see).
class MaterialTable {
public:
    MaterialTable(const Scene& scene, const EmbreeScene& geometry, bool evaluate_everything);

    /// `view` points from the surface to the viewer.
    ShadedPoint shade(uint32_t instance, uint32_t triangle, float u, float v, glm::vec3 view) const;

    /// Radiance that the material emits at barycentrics (u, v), on a side that emits.
    glm::vec3 emission(uint32_t instance, uint32_t triangle, float u, float v) const;

    /// What emission() cannot exceed but by vertex colours above 1.
    glm::vec3 greatest_emission(uint32_t material) const { return constants_[material].surface.emitted; }

    bool emits(uint32_t material) const { return constants_[material].emits; }
    bool emission_varies(uint32_t material) const { return constants_[material].emission_varies; }

    /// Whether any material has textures or vertex colours.
    bool any_varies() const {
        return std::ranges::any_of(constants_, [](const Constants& each) { return each.varies; });
    }

private:
    struct Constants {
        ShadedPoint surface;  ///< base colour, metalness, roughness, specular and emission, if no texture varies them
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
    void vary(const Material& material, const Corners& corners, const InstanceRecord& instance, ShadedPoint& point) const;
    glm::vec3 mapped_normal(const Material& material, const Corners& corners, const InstanceRecord& instance, glm::vec3 normal) const;

    const Scene& scene_;
    const EmbreeScene& geometry_;
    std::vector<Constants> constants_;
};

inline ShadedPoint MaterialTable::shade(uint32_t instance_index, uint32_t triangle, float u, float v, glm::vec3 view) const {
    const InstanceRecord& instance = geometry_.instance(instance_index);
    const SurfacePoint surface = geometry_.point(instance_index, triangle, u, v);
    const Constants& constants = constants_[instance.material];
    ShadedPoint point = constants.surface;
    point.position = surface.position;
    point.error = surface.error;
    point.geometric_normal = surface.front_normal;
    point.normal = surface.normal;
    if (constants.varies) vary(scene_.materials[instance.material], corners(instance_index, triangle, u, v), instance, point);

    if (glm::dot(surface.front_normal, view) < 0) {
        point.geometric_normal = -point.geometric_normal;
        point.normal = -point.normal;
        if (!constants.emits_behind) point.emitted = glm::vec3(0.0f);
    }
    return point;
}
