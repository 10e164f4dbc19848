#include "core/gbuffer/scene_facts.h"

#include "core/number_text.h"
#include "core/scene/texture_slots.h"
#include "core/shared/brdf.h"

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <functional>
#include <limits>
#include <set>

namespace {

std::set<unsigned> drawn_materials(const Scene& scene) {
    std::set<unsigned> result;
    for (const Instance& instance : scene.instances) {
        const Mesh& mesh = scene.meshes[instance.mesh];
        if (!mesh.indices.empty()) result.insert(mesh.material);
    }
    return result;
}

template <class Code>
glm::vec2 range_of_codes(const std::vector<uint8_t>& rgba, unsigned channel) {
    Code least = std::numeric_limits<Code>::max(), most = 0;
    for (size_t i = channel * sizeof(Code); i < rgba.size(); i += 4 * sizeof(Code)) {
        Code code;
        std::memcpy(&code, &rgba[i], sizeof code);
        least = std::min(least, code);
        most = std::max(most, code);
    }
    return glm::vec2(least, most) / float(std::numeric_limits<Code>::max());
}

/// Smallest and largest value of a channel (0: red) of a texture, 1 if there is none. Bilinear filtering stays within.
glm::vec2 channel_range(const Scene& scene, const TextureSlot& slot, unsigned channel) {
    if (slot.texture < 0) return glm::vec2(1);
    const Texture& texture = scene.textures[size_t(slot.texture)];
    return texture.channel_bytes == 2 ? range_of_codes<uint16_t>(*texture.rgba, channel)
                                      : range_of_codes<uint8_t>(*texture.rgba, channel);
}

/// Smallest and largest of what a surface's specular term is not zero for: the larger of its specular factor and its
/// metalness.
glm::vec2 specular_range(const Scene& scene, const Material& material) {
    if (material.is_unlit) return glm::vec2(0);
    return glm::max(material.specular * channel_range(scene, material.specular_texture, 3),
                    material.metalness * channel_range(scene, material.metalness_roughness_texture, 2));
}

bool is_matte(const Scene& scene, const Material& material) {
    return !is_stored_as_reflective(specular_range(scene, material).x);
}

bool has_texture(const Material& m) {
    return std::ranges::any_of(texture_slots(m), [](const TextureSlot* slot) { return slot->texture >= 0; });
}

bool has_dielectric_f0(const Material& m) {
    const bool is_metal = m.metalness == 1.0f && m.metalness_roughness_texture.texture < 0;
    return !m.is_unlit && !is_metal && m.specular > 0 && (has_own_dielectric_f0(m) || m.specular_texture.texture >= 0);
}

void add_material(SceneFacts& facts, const Scene& scene, const Material& material) {
    facts.has_textures |= has_texture(material);
    facts.has_alpha_masks |= material.alpha_mode == AlphaMode::mask;
    facts.hides_backs |= scene.hides_backs_of(material);
    facts.has_normal_maps |= material.normal_texture.texture >= 0;
    facts.has_matte |= is_matte(scene, material);
    facts.has_dielectric_f0 |= has_dielectric_f0(material);
    if (!(specular_range(scene, material).y > 0)) return;
    const glm::vec2 roughness = material.roughness * channel_range(scene, material.metalness_roughness_texture, 1);
    facts.has_reflective = true;
    facts.min_roughness = std::min(facts.min_roughness, roughness.x);
    facts.max_roughness = std::max(facts.max_roughness, roughness.y);
}

bool has_vertex_colors(const Scene& scene) {
    return std::ranges::any_of(scene.instances, [&](const Instance& instance) {
        return std::ranges::any_of(scene.meshes[instance.mesh].vertices,
                                   [](const Vertex& v) { return v.color != glm::vec4(1); });
    });
}

void add_motion(SceneFacts& facts, const Scene& scene, const SceneCamera& camera, std::span<const unsigned> frames) {
    ScenePose before = pose_scene(scene, float(frames.front()));
    glm::mat4 view_before = pose_camera(camera, before, float(frames.front())).world_from_view;
    for (const unsigned frame : frames.subspan(1)) {
        const ScenePose now = pose_scene(scene, float(frame));
        const glm::mat4 view_now = pose_camera(camera, now, float(frame)).world_from_view;
        facts.camera_moves |= view_now != view_before;
        facts.objects_move |=
            now.world_from_instance != before.world_from_instance || now.deformations != before.deformations;
        before = now;
        view_before = view_now;
    }
}

std::string by_material(const Scene& scene, const std::function<bool(const Material&)>& has) {
    std::string names;
    unsigned count = 0;
    for (unsigned material : drawn_materials(scene)) {
        if (!has(scene.materials[material])) continue;
        if (++count <= 3) names += (names.empty() ? "'" : ", '") + scene.materials[material].name + "'";
    }
    if (count > 3) names += " and " + std::to_string(count - 3) + " more";
    return names.empty() ? "no drawn material has it" : "by material " + names;
}

}  // namespace

SceneFacts material_facts(const Scene& scene) {
    SceneFacts facts{.has_matte = false};
    const std::set<unsigned> materials = drawn_materials(scene);
    facts.has_geometry = !materials.empty();
    for (unsigned material : materials) add_material(facts, scene, scene.materials[material]);
    facts.has_vertex_colors = has_vertex_colors(scene);
    facts.has_environment = !scene.environment.is_black();
    return facts;
}

SceneFacts derive_facts(const Scene& scene, const SceneCamera& camera, std::span<const unsigned> frames) {
    SceneFacts facts = material_facts(scene);
    if (!frames.empty()) add_motion(facts, scene, camera, frames);
    return facts;
}

std::vector<SceneFact> list_facts(const Scene& scene, const SceneFacts& f) {
    const auto yes = [](bool value) { return value ? "yes" : "no"; };
    const std::string roughness = f.has_reflective
                                      ? "perceptual roughness of reflective surfaces is " +
                                            number_text(f.min_roughness, 3) + " to " + number_text(f.max_roughness, 3)
                                      : "no drawn surface reflects specularly";
    return {
        {"has_geometry", yes(f.has_geometry), std::to_string(scene.triangle_count()) + " triangles"},
        {"has_reflective", yes(f.has_reflective), roughness},
        {"has_matte", yes(f.has_matte), by_material(scene, [&](const Material& m) { return is_matte(scene, m); })},
        {"min_roughness", number_text(f.min_roughness, 3), roughness},
        {"max_roughness", number_text(f.max_roughness, 3), roughness},
        {"camera_moves", yes(f.camera_moves), "camera poses of successive frames of the shot"},
        {"objects_move", yes(f.objects_move), "drawn nodes, joints and morph weights in successive frames of the shot"},
        {"has_faulty_inputs", yes(f.has_faulty_inputs),
         "values of a G-buffer from files that are not finite, or normals that are not unit"},
        {"has_environment", yes(f.has_environment),
         f.has_environment ? "the environment is not black" : "the environment is black"},
        {"has_textures", yes(f.has_textures), by_material(scene, has_texture)},
        {"has_alpha_masks", yes(f.has_alpha_masks),
         by_material(scene, [](const Material& m) { return m.alpha_mode == AlphaMode::mask; })},
        {"hides_backs", yes(f.hides_backs),
         scene.draws_backs ? "single-sided surfaces are seen from behind, too"
                           : by_material(scene, [&](const Material& m) { return scene.hides_backs_of(m); })},
        {"has_normal_maps", yes(f.has_normal_maps),
         by_material(scene, [](const Material& m) { return m.normal_texture.texture >= 0; })},
        {"has_vertex_colors", yes(f.has_vertex_colors), "vertex colours other than white"},
    };
}

PixelFacts pixel_facts(const HostGBuffer& g) {
    PixelFacts facts;
    const glm::vec2 extent(g.extent());
    const float share = 1.0f / float(g.depth.pixel_count());
    size_t background = 0, reflective = 0, mirror = 0, moving = 0;
    for (size_t i = 0; i < g.depth.pixel_count(); ++i) {
        if (g.depth.values[i] == g.camera.depth.z) {
            ++background;
            continue;
        }
        moving += glm::length(glm::vec2(g.motion.values[2 * i], g.motion.values[2 * i + 1]) * extent) > 0.01f;
        const float metalness = g.base_color.values[4 * i + 3], specular = g.emission.values[4 * i + 3];
        if (!(specular_f90(metalness, specular) > 0)) continue;
        const float roughness = g.normal.values[4 * i + 3];
        ++reflective;
        mirror += roughness * roughness <= min_ggx_alpha;
        facts.min_roughness = std::min(facts.min_roughness, roughness);
        facts.max_roughness = std::max(facts.max_roughness, roughness);
    }
    facts.background = background * share;
    facts.reflective = reflective * share;
    facts.mirror = mirror * share;
    facts.moving = moving * share;
    return facts;
}

std::vector<SceneFact> list_facts(const PixelFacts& facts) {
    const auto percent = [](float share) { return fixed_text(100 * share, 1) + " %"; };
    return {{"background_pixels", percent(facts.background), "nothing is drawn there"},
            {"reflective_pixels", percent(facts.reflective), "their specular reflectance is not zero"},
            {"mirror_pixels", percent(facts.mirror), "reflective and not rougher than a mirror"},
            {"moving_pixels", percent(facts.moving),
             "surfaces that move by more than 1/100 of a pixel since the frame before"}};
}
