// What is understood of a scene, whatever file it came from.
#include "core/parameters.h"
#include "core/scene/camera.h"
#include "core/scene/scene.h"
#include "experiments/bridges/inspect/channel_range.h"
#include "experiments/bridges/inspect/describe.h"
#include "experiments/study/config/shots/scene_warnings.h"

#include <cmath>
#include <map>
#include <set>

namespace {

Description vector_entry(glm::vec3 v) { return {json_number(v.x), json_number(v.y), json_number(v.z)}; }

Description camera_entry(const Scene& scene, const SceneCamera& camera) {
    Description entry = {{"name", camera.name},
                         {"projection", camera.is_orthographic ? "orthographic" : "perspective"}};
    if (camera.is_orthographic)
        entry["height"] = json_number(camera.orthographic_height);
    else
        entry["vertical_fov"] = json_number(glm::degrees(camera.vertical_fov));
    if (camera.aspect > 0) entry["aspect"] = json_number(camera.aspect);
    entry["near"] = json_number(camera.near), entry["far"] = json_number(camera.far);
    entry["frames"] = camera.frame_count;
    if (camera.node >= 0)
        entry["node"] = scene.nodes.at(size_t(camera.node)).name;
    else
        entry["keys"] = camera.keys.size();
    if (camera.exposure_ev != 0) entry["exposure_ev"] = json_number(camera.exposure_ev);
    return entry;
}

Description light_entry(const Scene& scene, const PunctualLight& light) {
    const char* const types[] = {"directional", "point", "spot"};
    Description entry = {
        {"name", light.name},
        {"type", types[size_t(light.type)]},
        {light.type == LightType::directional ? "irradiance" : "intensity", vector_entry(light.intensity)},
        {"unit", light.type == LightType::directional ? "W m^-2" : "W sr^-1"}};
    if (light.range > 0) entry["range"] = json_number(light.range);
    if (light.type == LightType::spot)
        entry["inner_cone"] = json_number(glm::degrees(std::acos(light.inner_cone_cos))),
        entry["outer_cone"] = json_number(glm::degrees(std::acos(light.outer_cone_cos)));
    if (light.node >= 0) entry["node"] = scene.nodes.at(size_t(light.node)).name;
    return entry;
}

Description environment_entry(const Environment& environment) {
    switch (environment.type) {
        case Environment::Type::constant:
            return {{"type", "constant"}, {"radiance", vector_entry(environment.color)}};
        case Environment::Type::gradient:
            return {{"type", "gradient"},
                    {"color", vector_entry(environment.color)},
                    {"slope", vector_entry(environment.slope)},
                    {"axis", vector_entry(environment.axis)}};
        case Environment::Type::image:
            break;
    }
    Description entry = {{"type", "image"},
                         {"width", environment.latlong.extent.x},
                         {"height", environment.latlong.extent.y},
                         {"rotation", json_number(glm::degrees(environment.rotation))}};
    float largest = 0;
    Description means = Description::array();
    for (unsigned c = 0; c < environment.latlong.channels; ++c) {
        const ChannelRange range = channel_range(environment.latlong, c);
        means.push_back(Description(json_number(float(range.mean)))), largest = std::max(largest, range.largest);
    }
    entry["mean"] = means, entry["largest"] = json_number(largest);
    return entry;
}

Description slot_entry(const TextureSlot& slot) {
    Description entry = {{"texture", slot.texture}};
    if (slot.texcoord != 0) entry["texcoord"] = slot.texcoord;
    if (slot.uv_transform != glm::mat3(1.0f))
        for (int row = 0; row < 2; ++row)  // u' and v' of (u, v, 1)
            entry["uv_transform"].push_back(
                vector_entry({slot.uv_transform[0][row], slot.uv_transform[1][row], slot.uv_transform[2][row]}));
    return entry;
}

Description material_entry(const Material& material, size_t triangles) {
    Description entry = {{"name", material.name},
                         {"triangles", triangles},
                         {"base_color", vector_entry(material.base_color)},
                         {"metalness", json_number(material.metalness)},
                         {"roughness", json_number(material.roughness)},
                         {"emission", vector_entry(material.emission)},
                         {"specular", json_number(material.specular)},
                         {"specular_color", vector_entry(material.specular_color)},
                         {"dielectric_f0", json_number(material.dielectric_f0)},
                         {"alpha_mode", material.alpha_mode == AlphaMode::mask ? "mask" : "opaque"},
                         {"is_double_sided", material.is_double_sided},
                         {"is_unlit", material.is_unlit},
                         {"textures", Description::object()}};
    if (material.alpha_mode == AlphaMode::mask)
        entry["alpha"] = json_number(material.alpha), entry["alpha_cutoff"] = json_number(material.alpha_cutoff);
    const std::pair<const char*, const TextureSlot*> slots[] = {
        {"base_color", &material.base_color_texture},
        {"metalness_roughness", &material.metalness_roughness_texture},
        {"normal", &material.normal_texture},
        {"occlusion", &material.occlusion_texture},
        {"emission", &material.emission_texture},
        {"specular", &material.specular_texture},
        {"specular_color", &material.specular_color_texture}};
    for (const auto& [name, slot] : slots)
        if (slot->texture >= 0) entry["textures"][name] = slot_entry(*slot);
    return entry;
}

Description texture_entry(const Texture& texture) {
    const char* const wraps[] = {"repeat", "mirrored_repeat", "clamp_to_edge"};
    return {{"name", texture.name},
            {"width", texture.extent.x},
            {"height", texture.extent.y},
            {"bits", 8 * texture.channel_bytes},
            {"colors", texture.is_srgb ? "sRGB" : "linear"},
            {"wrap_u", wraps[size_t(texture.wrap_u)]},
            {"wrap_v", wraps[size_t(texture.wrap_v)]},
            {"filter", texture.is_nearest ? "nearest" : "bilinear"}};
}

/// Channels by what they move.
Description animation_entry(const Scene& scene) {
    if (scene.animation.empty()) return nullptr;
    float end = 0;
    std::map<AnimationChannel::Property, size_t> channels;
    std::set<unsigned> nodes;
    for (const AnimationChannel& channel : scene.animation) {
        ++channels[channel.property], nodes.insert(channel.node);
        if (!channel.times.empty()) end = std::max(end, channel.times.back());
    }
    return {{"seconds", json_number(end)},
            {"nodes", nodes.size()},
            {"translations", channels[AnimationChannel::Property::translation]},
            {"rotations", channels[AnimationChannel::Property::rotation]},
            {"scales", channels[AnimationChannel::Property::scale]},
            {"weights", channels[AnimationChannel::Property::weight]}};
}

Description warning_entries(const Scene& scene, const std::vector<WarningShare>& warnings) {
    Description entries = Description::array();
    for (const auto& [warning, share] : warnings) {
        Description& entry = entries.emplace_back(Description{{"text", warning.text}});
        if (warning.material >= 0) entry["material"] = scene.materials.at(size_t(warning.material)).name;
        if (warning.node >= 0) entry["node"] = scene.nodes.at(size_t(warning.node)).name;
        if (share) entry["share_of_first_view"] = *share;
    }
    return entries;
}

}  // namespace

Description describe_scene(const Scene& scene) {
    const auto [low, high] = scene_bounds(scene, pose_scene(scene, 0.0f));
    std::vector<size_t> triangles(scene.materials.size());
    for (const Instance& instance : scene.instances) {
        const Mesh& mesh = scene.meshes[instance.mesh];
        triangles[mesh.material] += mesh.indices.size() / 3;
    }
    Description entry = {{"kind", "scene"},
                         {"name", scene.name},
                         {"asset", scene.asset},
                         {"bounds", {{"low", vector_entry(low)}, {"high", vector_entry(high)}}},
                         {"triangles", scene.triangle_count()},
                         {"instances", scene.instances.size()},
                         {"meshes", scene.meshes.size()},
                         {"nodes", scene.nodes.size()},
                         {"frames", scene.frame_count},
                         {"frame_rate", json_number(scene.frame_rate)},
                         {"backs_of_single_sided_surfaces", scene.draws_backs ? "drawn" : "not drawn"},
                         {"animation", animation_entry(scene)},
                         {"environment", environment_entry(scene.environment)}};
    for (const char* list : {"clips", "skins", "cameras", "lights", "materials", "textures"})
        entry[list] = Description::array();
    for (const AnimationClip& clip : scene.clips)
        entry["clips"].push_back({{"name", clip.name}, {"is_played", clip.is_played}});
    for (const Skin& skin : scene.skins) entry["skins"].push_back({{"joints", skin.joints.size()}});
    entry["meshes_with_morph_targets"] =
        std::ranges::count_if(scene.meshes, [](const Mesh& mesh) { return !mesh.targets.empty(); });
    for (const SceneCamera& camera : scene.cameras) entry["cameras"].push_back(camera_entry(scene, camera));
    for (const PunctualLight& light : scene.lights) entry["lights"].push_back(light_entry(scene, light));
    for (size_t i = 0; i < scene.materials.size(); ++i)
        entry["materials"].push_back(material_entry(scene.materials[i], triangles[i]));
    for (const Texture& texture : scene.textures) entry["textures"].push_back(texture_entry(texture));
    const ShownWarnings warnings = shown_warnings(scene, scene.warnings.size());
    entry["warnings"] = warning_entries(scene, warnings.all);
    entry["ignored"] = warnings.sentences;
    return entry;
}
