#include "experiments/shot.h"

#include "core/files.h"
#include "core/scene/load_scene.h"

#include <algorithm>
#include <span>

std::string Shot::name(unsigned frame) const {
    std::string name = scene.name + "." + camera.name + "." + std::to_string(config.extent.x) + "x" + std::to_string(config.extent.y);
    if (config.frames != std::vector<unsigned>{0}) name += ".f" + std::to_string(frame);
    return name;
}

Shot load_shot(const ShotConfig& config, const std::vector<std::filesystem::path>& search_path) {
    Shot shot{.config = config, .scene = load_scene(config.scene, search_path), .camera = {}, .facts = {}};
    shot.camera = shot.scene.camera(config.camera);
    const unsigned first = config.frames.front(), last = config.frames.back();
    shot.facts = derive_facts(shot.scene, shot.camera, first, last - first + 1);
    return shot;
}

Shot gbuffer_shot(const ShotConfig& config, const HostGBuffer& gbuffer) {
    Shot shot{.config = config, .scene = {}, .camera = {.name = "gbuffer"}, .facts = {}};
    shot.config.extent = gbuffer.extent();
    shot.scene.name = std::filesystem::absolute(config.gbuffer).lexically_normal().filename().string();
    ContentHash hash;
    for (const HostImage* image : {&gbuffer.depth, &gbuffer.geometric_normal, &gbuffer.normal, &gbuffer.base_color, &gbuffer.emission, &gbuffer.motion, &gbuffer.material_id, &gbuffer.previous_depth, &gbuffer.previous_normal, &gbuffer.lit, &gbuffer.fallback}) hash.add(std::as_bytes(std::span(image->values)));
    hash.add(std::as_bytes(std::span(&gbuffer.camera, 1)));
    shot.scene.content_hash = hash.hex();
    SceneFacts& facts = shot.facts;
    facts.camera_moves = facts.objects_move = true;  // unknown, so nothing is left out for lack of it
    for (size_t i = 0; i < gbuffer.depth.values.size(); ++i) {
        if (gbuffer.depth.values[i] == gbuffer.camera.depth.z) continue;
        facts.has_geometry = true;
        const float roughness = gbuffer.normal.values[i * 4 + 3];
        if (gbuffer.base_color.values[i * 4 + 3] <= 0.0f && gbuffer.emission.values[i * 4 + 3] <= 0.0f) continue;
        facts.has_reflective = true;
        facts.min_roughness = std::min(facts.min_roughness, roughness), facts.max_roughness = std::max(facts.max_roughness, roughness);
    }
    return shot;
}

ShotFrame shot_frame(const Shot& shot, unsigned frame) {
    ShotFrame now{.frame = frame, .scene = pose_scene(shot.scene, float(frame)), .camera = {}};
    now.camera = pose_camera(shot.camera, now.scene, float(frame));
    return now;
}
