#pragma once
#include "core/gbuffer/gbuffer_file.h"
#include "core/gbuffer/scene_facts.h"
#include "core/scene/camera.h"
#include "core/scene/scene.h"
#include "experiments/config.h"

#include <filesystem>
#include <string>
#include <vector>

/// A camera of a loaded scene: what a ShotConfig names.
struct Shot {
    ShotConfig config;
    Scene scene;
    SceneCamera camera;
    SceneFacts facts;

    /// `<scene>.<camera>.<width>x<height>`, and `.f<frame>` where the shot has several frames.
    std::string name(unsigned frame) const;
};

/// Fails with Error if the scene or the camera is unknown (with a near miss) or broken.
Shot load_shot(const ShotConfig& config, const std::vector<std::filesystem::path>& search_path);

/// A shot of a G-buffer from files: no scene, one frame; its facts are those of the images.
Shot gbuffer_shot(const ShotConfig& config, const HostGBuffer& gbuffer);

/// Scene and camera at one frame of a shot.
struct ShotFrame {
    unsigned frame = 0;
    ScenePose scene;
    CameraPose camera;
};
ShotFrame shot_frame(const Shot& shot, unsigned frame);
