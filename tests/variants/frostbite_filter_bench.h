#pragma once
#include "core/gbuffer/split_sum_image.h"
#include "tests/variants/frostbite_passes.h"

/// What frostbite_resolve() would leave of one pixel.
struct ResolvedPixel {
    glm::vec3 radiance{0};
    float confidence = 1, ray_length = 0;
};

/// Frostbite's temporal filter over frames in a row, with resolved rays that a test makes up.
class FrostbiteFilterBench {
public:
    FrostbiteFilterBench(Device& device, const FrameView& view, const nlohmann::json& parameters);

    /// Channels: incident radiance, confidence. `resolved` is asked for each pixel.
    HostImage next(const CameraPose& pose, const SyntheticScene& scene,
                   const std::function<ResolvedPixel(glm::uvec2 pixel, const CameraRay& ray)>& resolved);

    FrameView view;  ///< its jitter may change between frames
    FrostbiteParameters parameters;
    PassList pass_list;

private:
    GBuffer upload(const CameraPose& pose, const SyntheticScene& scene);

    SplitSumImage split_sum_;
    CameraPose pose_before_;
    HostImage depth_before_, normal_before_;
    CameraData camera_{};
};
