#pragma once
#include "tests/variants/frostbite_bench.h"

/// What one frame is made of. By default each traced pixel's ray mirrors the view and shows the colour of the pixel
/// itself.
struct RayFrame {
    std::function<glm::vec3(glm::uvec2)> color = [](glm::uvec2) { return glm::vec3(0); };
    /// Beside what the camera's motion makes (uv).
    std::function<glm::vec2(glm::uvec2)> motion = [](glm::uvec2) { return glm::vec2(0); };
    std::function<void(glm::uvec2, StoredRay&)> change = [](glm::uvec2, StoredRay&) {};
};

inline RayFrame of_one_color(float value) {
    return {.color = [=](glm::uvec2) { return glm::vec3(value); }};
}

inline unsigned packed(glm::uvec2 pixel) { return pixel.x | pixel.y << 16; }

/// Frames in a row of one denoiser, with rays that a test makes up.
class DenoiserBench {
public:
    DenoiserBench(Device& device, const std::string& denoiser, const CameraPose& pose, glm::uvec2 extent,
                  SyntheticScene scene, const nlohmann::json& own,
                  const nlohmann::json& of_technique = nlohmann::json::object());

    /// Channels: radiance, confidence.
    HostImage next(const RayFrame& frame);

    CameraPose pose;  ///< of the next frame
    PassList pass_list;
    float environment = 0;             ///< everywhere
    std::optional<ScreenProbe> probe;  ///< of the last frame, where `misses` is probe

private:
    std::vector<glm::uvec2> traced_pixels() const;
    void keep_previous(GBuffer& gbuffer);

    SyntheticScene scene_;
    ParameterSet technique_;
    std::unique_ptr<Denoiser> denoiser_;
    CameraPose pose_before_;
    HostImage depth_before_, normal_before_;
    unsigned frame_ = 0;
};
