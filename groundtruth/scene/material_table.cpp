#include "groundtruth/scene/material_table.h"

#include "core/scene/texture_slots.h"
#include "groundtruth/sampling/prefetch.h"
#include "groundtruth/scene/alpha_mask.h"

namespace {

bool has_colors(const Scene& scene, unsigned material) {
    for (const Mesh& mesh : scene.meshes)
        if (mesh.material == material)
            for (const Vertex& vertex : mesh.vertices)
                if (glm::vec3(vertex.color) != glm::vec3(1.0f)) return true;
    return false;
}

}  // namespace

MaterialTable::MaterialTable(const Scene& scene, const EmbreeScene& geometry, bool evaluate_everything)
    : scene_(scene), geometry_(geometry), textures_(scene) {
    for (unsigned i = 0; i < scene.materials.size(); ++i) {
        const Material& material = scene.materials[i];
        const bool has_color = material.base_color_texture.texture >= 0 || has_colors(scene, i);
        Constants& constants = constants_.emplace_back();
        ShadedPoint& surface = constants.surface;
        surface.is_unlit = material.is_unlit;
        surface.base_color = material.is_unlit ? glm::vec3(0.0f) : material.base_color;
        surface.metalness = material.metalness;
        surface.roughness = material.roughness;
        surface.specular = material.is_unlit ? 0.0f : material.specular;
        surface.dielectric_f0 = glm::min(material.dielectric_f0 * material.specular_color, 1.0f);
        surface.emitted = material.is_unlit ? material.base_color : material.emission;
        constants.varies = evaluate_everything || has_color || material.metalness_roughness_texture.texture >= 0 ||
                           material.normal_texture.texture >= 0 || material.emission_texture.texture >= 0 ||
                           material.specular_texture.texture >= 0 || material.specular_color_texture.texture >= 0;
        any_varies_ |= constants.varies;
        any_dielectric_f0_ |= has_own_dielectric_f0(material);
        constants.emission_varies = evaluate_everything || material.alpha_mode == AlphaMode::mask ||
                                    (material.is_unlit ? has_color : material.emission_texture.texture >= 0);
        constants.emits = surface.emitted != glm::vec3(0.0f);
        constants.emits_behind = material.is_double_sided;
    }
}

MaterialTable::Corners MaterialTable::corners(uint32_t instance_index, uint32_t triangle, float u, float v) const {
    const InstanceRecord& instance = geometry_.instance(instance_index);
    const TriangleRecord& record = instance.triangles[triangle];
    const Vertex* vertices = instance.vertices;
    return {{vertices + record.corner[0], vertices + record.corner[1], vertices + record.corner[2]},
            {1.0f - u - v, u, v}};
}

void MaterialTable::prefetch_corners(uint32_t instance_index, uint32_t triangle) const {
    const InstanceRecord& instance = geometry_.instance(instance_index);
    if (!constants_[instance.material].varies) return;
    for (const uint32_t corner : instance.triangles[triangle].corner) {
        const char* vertex = reinterpret_cast<const char*>(&instance.vertices[corner]);
        prefetch_line(vertex);
        prefetch_line(vertex + sizeof(Vertex) - 1);
    }
}

void MaterialTable::prefetch_texels(uint32_t instance_index, uint32_t triangle, float u, float v) const {
    const InstanceRecord& instance = geometry_.instance(instance_index);
    if (!constants_[instance.material].varies) return;
    const Material& material = scene_.materials[instance.material];
    const Corners at = corners(instance_index, triangle, u, v);
    for (const TextureSlot* slot : texture_slots(material))
        if (slot->texture >= 0) textures_.prefetch(slot->texture, at.uv(*slot));
}

glm::vec2 MaterialTable::Corners::uv(const TextureSlot& slot) const {
    const unsigned set = slot.texcoord;
    const glm::vec2 at =
        weight[0] * vertex[0]->uv[set] + weight[1] * vertex[1]->uv[set] + weight[2] * vertex[2]->uv[set];
    return glm::vec2(slot.uv_transform * glm::vec3(at, 1.0f));
}

glm::vec4 MaterialTable::Corners::color() const {
    // Differences, so that three equal colours give that colour to the bit.
    const glm::vec4 color = vertex[0]->color;
    return color + weight[1] * (vertex[1]->color - color) + weight[2] * (vertex[2]->color - color);
}

glm::vec4 MaterialTable::sample(const TextureSlot& slot, const Corners& corners) const {
    return slot.texture < 0 ? glm::vec4(1.0f) : textures_.sample(slot.texture, corners.uv(slot));
}

glm::vec3 MaterialTable::mapped_normal(const Material& material, const Corners& corners, const InstanceRecord& instance,
                                       glm::vec3 normal) const {
    const glm::vec4 texel = sample(material.normal_texture, corners);
    const glm::vec3 local =
        (2.0f * glm::vec3(texel) - 1.0f) * glm::vec3(material.normal_scale, material.normal_scale, 1.0f);
    const glm::vec3 tangent_sum = corners.weight[0] * glm::vec3(corners.vertex[0]->tangent) +
                                  corners.weight[1] * glm::vec3(corners.vertex[1]->tangent) +
                                  corners.weight[2] * glm::vec3(corners.vertex[2]->tangent);
    glm::vec3 tangent = glm::mat3(instance.world_from_object) * tangent_sum;
    const float length = glm::length(tangent);
    if (!(length > 0)) return normal;
    tangent /= length;
    const float handedness = corners.vertex[0]->tangent.w * (instance.is_mirrored ? -1.0f : 1.0f);
    const glm::vec3 bitangent = handedness * glm::cross(normal, tangent);
    const glm::vec3 mapped = local.x * tangent + local.y * bitangent + local.z * normal;
    const float mapped_length = glm::length(mapped);
    return mapped_length > 0 ? mapped / mapped_length : normal;
}

/// All but the place and the normals.
ShadedPoint MaterialTable::properties(const Material& material, const Corners& corners) const {
    const glm::vec3 color =
        material.base_color * glm::vec3(corners.color()) * glm::vec3(sample(material.base_color_texture, corners));
    const glm::vec4 metalness_roughness = sample(material.metalness_roughness_texture, corners);
    ShadedPoint point;
    point.is_unlit = material.is_unlit;
    point.base_color = material.is_unlit ? glm::vec3(0.0f) : color;
    point.metalness = material.metalness * metalness_roughness.b;
    point.roughness = material.roughness * metalness_roughness.g;
    point.specular = material.is_unlit ? 0.0f : material.specular * sample(material.specular_texture, corners).a;
    point.dielectric_f0 = glm::min(
        material.dielectric_f0 * material.specular_color * glm::vec3(sample(material.specular_color_texture, corners)),
        1.0f);
    point.emitted =
        material.is_unlit ? color : material.emission * glm::vec3(sample(material.emission_texture, corners));
    return point;
}

ShadedPoint MaterialTable::shade_varying(SurfacePoint surface, uint32_t instance_index, uint32_t triangle, float u,
                                         float v, glm::vec3 view, float distance) const {
    const InstanceRecord& instance = geometry_.instance(instance_index);
    const Material& material = scene_.materials[instance.material];
    const Corners at = corners(instance_index, triangle, u, v);
    if (material.normal_texture.texture >= 0)
        surface.normal = mapped_normal(material, at, instance, unit_normal(surface.normal, surface.front_normal));
    return facing(surface, properties(material, at), material.is_double_sided, view, distance);
}

glm::vec3 MaterialTable::emission(uint32_t instance_index, uint32_t triangle, float u, float v) const {
    const InstanceRecord& instance = geometry_.instance(instance_index);
    const Constants& constants = constants_[instance.material];
    if (!constants.emission_varies) return constants.surface.emitted;
    const Material& material = scene_.materials[instance.material];
    const int texture = material.base_color_texture.texture;
    if (is_cut_out(material, texture < 0 ? nullptr : &scene_.textures[size_t(texture)], *instance.mesh,
                   instance.triangles[triangle].corner, u, v))
        return glm::vec3(0.0f);
    return properties(material, corners(instance_index, triangle, u, v)).emitted;
}
