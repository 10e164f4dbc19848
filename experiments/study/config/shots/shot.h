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
    unsigned index = 0;                      ///< number of steps before this one
    unsigned frame = 0;                      ///< the frame, which gives the pose
    std::optional<unsigned> previous_frame;  ///< frame of the step before; none: this is the first step
    bool is_warm_up = false;
    bool is_held = false;      ///< one of the last pose's repetitions, including the first
    bool is_measured = false;  ///< the last rendering of a measured frame
};

/// The frames that are rendered, in order: warm-up, each of the shot's frames, repetitions of the last.
std::vector<FrameStep> timeline(const ShotConfig& config);

/// Which images of a rendering are kept.
enum class StepImages { none, reflections, all };

/// A loaded ShotConfig: scene, camera and frames.
struct Shot {
    ShotConfig config;
    Scene scene;
    SceneCamera camera;
    SceneFacts facts;
    std::vector<FrameStep> steps;

    /// `<scene>.<camera>.<width>x<height>`, followed by what is not the default: `.f<frame>` or `.f<first>-<last>` (and
    /// `.n<count>` if frames between are left out), `.w<warm-up>`, `.r<repetitions>`, and settings that differ from the
    /// study's: `.direct`, `.d16`, `.reversed`, `.octahedral_8` and others.
    std::string name() const;

    /// Which images of a step are kept by a study that keeps `kept`.
    StepImages images_of(const FrameStep& step, KeptImages kept) const;
};

/// Loads the scene and finds the camera; the scene's warnings include plane_warnings(). Fails with Error if scene or
/// camera is unknown (with the nearest name) or broken.
Shot load_shot(const ShotConfig& config, const std::vector<std::filesystem::path>& search_path);

/// Scene and camera at one frame of a shot.
struct ShotFrame {
    unsigned frame = 0;
    ScenePose scene;
    CameraPose camera;
};
ShotFrame shot_frame(const Shot& shot, unsigned frame);
