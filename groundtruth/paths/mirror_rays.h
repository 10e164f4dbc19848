#pragma once
#include "core/scene/camera.h"
#include "core/scene/scene.h"

/// Where the mirror rays of reflecting pixels end, that is, whether screen-space techniques can find the ends.
struct MirrorRayShares {
    double reflective = 0;  ///< share of the pixels that send a ray: roughness at most reflective_roughness
    double seen = 0, hidden = 0, off = 0, behind = 0, sky = 0;  ///< shares of these rays; they add up to 1
    double thin = 0;  ///< share of these rays that end on a seen object of at most thin_thickness in depth
    double roughness = 0, reflectance = 0;  ///< medians over these pixels; reflectance: luminance of F0
};

inline constexpr float reflective_roughness = 0.351f;  ///< perceptual; 0.35 with its rounding
inline constexpr float thin_thickness = 0.1f;          ///< m

/// Traces one ray a pixel, at its centre, about the geometric normal. `reads_maps`: uses the roughness at the pixel;
/// else the material's, and leaves out materials with a roughness map.
MirrorRayShares trace_mirror_rays(const Scene& scene, const ScenePose& pose, const CameraPose& camera,
                                  glm::uvec2 extent, bool reads_maps);
