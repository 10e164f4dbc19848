#include "experiments/shot.h"

#include "core/scene/load_scene.h"

std::string Shot::name(unsigned frame) const {
    std::string name = scene.name + "." + camera.name + "." + std::to_string(config.extent.x) + "x" + std::to_string(config.extent.y);
    if (config.frames.size() > 1) name += ".f" + std::to_string(frame);
    return name;
}

Shot load_shot(const ShotConfig& config, const std::vector<std::filesystem::path>& search_path) {
    Shot shot{.config = config, .scene = load_scene(config.scene, search_path), .camera = {}, .facts = {}};
    shot.camera = shot.scene.camera(config.camera);
    const unsigned first = config.frames.front(), last = config.frames.back();
    shot.facts = derive_facts(shot.scene, shot.camera, first, last - first + 1);
    return shot;
}

ShotFrame shot_frame(const Shot& shot, unsigned frame) {
    ShotFrame now{.frame = frame, .scene = pose_scene(shot.scene, float(frame)), .camera = {}};
    now.camera = pose_camera(shot.camera, now.scene, float(frame));
    return now;
}
