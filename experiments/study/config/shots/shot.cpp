#include "experiments/study/config/shots/shot.h"

#include "core/error.h"
#include "core/scene/camera_planes.h"
#include "core/scene/load_scene.h"
#include "core/scene/unknown_scene.h"
#include "experiments/study/config/shots/plane_warnings.h"

#include <algorithm>
#include <iterator>

std::vector<FrameStep> timeline(const ShotConfig& config) {
    std::vector<FrameStep> steps;
    const auto render = [&](unsigned frame) -> FrameStep& {
        FrameStep step{.index = unsigned(steps.size()), .frame = frame};
        if (!steps.empty()) step.previous_frame = steps.back().frame;
        return steps.emplace_back(step);
    };
    for (unsigned i = 0; i < config.warm_up; ++i) render(config.frames.front()).is_warm_up = true;
    for (const unsigned frame : config.frames) {
        const bool is_last = frame == config.frames.back();
        for (unsigned i = 0; i < (is_last ? config.repeat : 1); ++i)
            render(frame).is_held = is_last && config.repeat > 1;
        steps.back().is_measured = is_last || (!config.measures_last_only && frame >= config.measure_from);
    }
    return steps;
}

std::string Shot::name() const {
    const unsigned first = config.frames.front(), last = config.frames.back();
    std::string name =
        scene.name + "." + camera.name + "." + std::to_string(config.extent.x) + "x" + std::to_string(config.extent.y);
    if (last > 0) name += ".f" + std::to_string(first);
    if (last > first) name += "-" + std::to_string(last);
    if (config.frames.size() != last - first + 1) name += ".n" + std::to_string(config.frames.size());
    if (config.warm_up > 0) name += ".w" + std::to_string(config.warm_up);
    if (config.repeat > 1) name += ".r" + std::to_string(config.repeat);
    return name + config.name_suffix;
}

StepImages Shot::images_of(const FrameStep& step, KeptImages kept) const {
    if (kept == KeptImages::none) return StepImages::none;
    if (&step == &steps.back() || (kept == KeptImages::measured && step.is_measured)) return StepImages::all;
    const bool is_played = kept == KeptImages::played && !step.is_warm_up && !step.is_held;
    return is_played ? StepImages::reflections : StepImages::none;
}

namespace {

/// The text of a mistake in a name, with the place where a config has the name.
std::string placed(const std::string& place, const Error& mistake) {
    return place.empty() ? mistake.what() : place + ": " + mistake.what();
}

Scene scene_of(const ShotConfig& config, const std::vector<std::filesystem::path>& search_path) {
    try {
        return load_scene(config.scene, search_path, config.choices);
    } catch (const UnknownScene& mistake) {
        fail(placed(config.named_at.scene, mistake));
    }
}

SceneCamera camera_of(const ShotConfig& config, const Scene& scene) {
    try {
        return scene.camera(config.camera);
    } catch (const Error& mistake) {
        fail(placed(config.named_at.camera, mistake));
    }
}

}  // namespace

Shot load_shot(const ShotConfig& config, const std::vector<std::filesystem::path>& search_path) {
    Shot shot{
        .config = config, .scene = scene_of(config, search_path), .camera = {}, .facts = {}, .steps = timeline(config)};
    shot.camera = camera_of(config, shot.scene);
    if (config.has_planes_of_scene) use_planes_of_scene(shot.camera, shot.scene);
    shot.facts = derive_facts(shot.scene, shot.camera, config.frames);
    shot.facts.has_environment |= config.has_probe;
    std::ranges::move(plane_warnings(shot), std::back_inserter(shot.scene.warnings));
    return shot;
}

ShotFrame shot_frame(const Shot& shot, unsigned frame) {
    ShotFrame now{.frame = frame, .scene = pose_scene(shot.scene, float(frame)), .camera = {}};
    now.camera = pose_camera(shot.camera, now.scene, float(frame));
    return now;
}
