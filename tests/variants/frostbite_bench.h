#pragma once
#include "core/gbuffer/split_sum_image.h"
#include "tests/variants/frostbite_technique.h"
#include "tests/variants/synthetic_gbuffer.h"
#include "variants/common/horizon_image.h"

/// A ray as ray.glsl stores it.
struct StoredRay {
    glm::vec3 direction{0};     ///< view space
    float inverse_density = 0;  ///< with which it comes about (sr)
    unsigned target = 0;        ///< pixel x | y << 16, or one of the markers below
    float length = 0;           ///< m
    float confidence = 1;
};
inline constexpr unsigned ray_missed = 0xffffffff, ray_below_horizon = 0xfffffffe, ray_into_surface = 0xfffffffd;

/// `rays`: max_rays for each traced pixel.
TracedRays upload_rays(PassList& pass_list, const std::vector<StoredRay>& rays);

struct ResolvedFrame {
    HostImage radiance, length;
};

/// Frostbite's resolve over a synthetic G-buffer, with rays that a test makes up.
class FrostbiteBench {
public:
    FrostbiteBench(Device& device, const CameraPose& pose, const FrameView& view, const SyntheticScene& scene,
                   const nlohmann::json& parameters);

    /// `rays`: max_rays for each traced pixel. `color`: 4 channels, of the screen's extent.
    ResolvedFrame resolve(const std::vector<StoredRay>& rays, const HostImage& color);
    /// `color`: with mips of the test's own making.
    ResolvedFrame resolve(const std::vector<StoredRay>& rays, const Image& color);

    /// The frame before: seen from `pose_before`, when the scene was `scene_before`, before it moved by `way`.
    void set_previous(const CameraPose& pose_before, const SyntheticScene& scene_before, glm::vec3 way = glm::vec3(0));

    glm::uvec2 traced_extent() const;
    void set_frame(unsigned index, unsigned seed) { camera.frame.x = index, camera.frame.y = seed; }

    ParameterSet params;
    FrostbiteRayParameters ray_parameters{params};
    FrostbiteResolveParameters resolve_parameters{params};
    PassList pass_list;
    CameraData camera;
    GBuffer gbuffer;

private:
    CameraPose pose_;
    FrameView view_;
    SyntheticScene scene_;
    SplitSumImage split_sum_;
    HorizonImage horizon_;
};
