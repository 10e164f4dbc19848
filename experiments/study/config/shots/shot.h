#pragma once
#include "core/gbuffer/scene_facts.h"
#include "core/scene/camera.h"
#include "core/scene/scene.h"
#include "experiments/study/config/config.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

/// One frame that is rendered.
struct FrameStep {
    unsigned index = 0;                      ///< how many were rendered before it
    unsigned frame = 0;                      ///< its pose
    std::optional<unsigned> previous_frame;  ///< pose of the one rendered before; none: it is the first
    bool is_warm_up = false;
    bool is_held = false;      ///< one of the last pose's repetitions, its first rendering included
    bool is_measured = false;  ///< the last rendering of a frame that is to be measured
};

/// The frames that are rendered, in order: warm-up, each of the shot's frames, repetitions of the last.
std::vector<FrameStep> timeline(const ShotConfig& config);

/// Which images of a rendering are kept.
enum class StepImages { none, reflections, all };

/// A camera of a loaded scene: what a ShotConfig names.
struct Shot {
    ShotConfig config;
    Scene scene;
    SceneCamera camera;
    SceneFacts facts;
    std::vector<FrameStep> steps;

    /// `<scene>.<camera>.<width>x<height>`, then, where they are not the default: `.f<frame>` or `.f<first>-<last>`
    /// (and `.n<count>` where some between are left out), `.w<warm-up>`, `.r<repetitions>`, and what is not the study's
    /// own of `.direct`, `.d16`, `.reversed`, `.octahedral_8` and the like.
    std::string name() const;

    /// What a study that keeps `kept` keeps of one of `steps`.
    StepImages images_of(const FrameStep& step, KeptImages kept) const;
};

/// Its scene's warnings hold those of the camera's planes, too. Fails with Error if the scene or the camera is unknown
/// (with a near miss) or broken.
Shot load_shot(const ShotConfig& config, const std::vector<std::filesystem::path>& search_path);

/// Scene and camera at one frame of a shot.
struct ShotFrame {
    unsigned frame = 0;
    ScenePose scene;
    CameraPose camera;
};
ShotFrame shot_frame(const Shot& shot, unsigned frame);
