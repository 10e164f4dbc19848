#pragma once
#include "core/scene/camera.h"
#include "core/scene/scene.h"

/// Where the mirror rays of what reflects in an image end: whether screen-space techniques can find them.
struct MirrorRayShares {
    double reflective = 0;  ///< of the pixels, those that send one: roughness at most reflective_roughness
    double seen = 0, hidden = 0, off = 0, behind = 0, sky = 0;  ///< of these; they add up to 1
    double thin = 0;  ///< of these, on a seen thing that is at most thin_thickness deep behind its front
    double roughness = 0, reflectance = 0;  ///< their medians; reflectance: luminance of F0
};

inline constexpr float reflective_roughness = 0.351f;  ///< perceptual; 0.35 with its rounding
inline constexpr float thin_thickness = 0.1f;          ///< m

/// One ray a pixel, at its centre, about the geometric normal. `reads_maps`: the roughness is that of the surface at
/// the pixel; else of its material, without those that have a map of it.
MirrorRayShares trace_mirror_rays(const Scene& scene, const ScenePose& pose, const CameraPose& camera,
                                  glm::uvec2 extent, bool reads_maps);
