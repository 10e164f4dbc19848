#ifndef SHARED_CAMERA_H
#define SHARED_CAMERA_H
#include "core/shared/language.h"

/// What a shader knows of the camera. Matrices are named target_from_source. Clip space is Vulkan's: y down, z in [0,
/// 1]; uv = ndc.xy * 0.5 + 0.5 has its origin at the top left. Only vec4, uvec4 and mat4, so that GLM and std140 agree.
struct CameraData {
    mat4 clip_from_view, view_from_clip;  ///< without TAA jitter
    mat4 view_from_world, world_from_view;
    mat4 clip_from_world, world_from_clip;  ///< the second one inverted in double precision
    mat4 previous_clip_from_world;  ///< of the frame before, without jitter; this frame's own in the first frame
    mat4 previous_view_from_world, previous_world_from_view, previous_view_from_clip;
    vec4 extent;  ///< width, height, 1 / width, 1 / height (pixels)
    vec4 depth;   ///< near (m), far (m), device depth of the far plane (1, or 0 if reversed), 1 if reversed
    vec4 jitter;  ///< TAA jitter of this and of the previous frame (pixels, y down): xy, zw
    uvec4 frame;  ///< number of frames rendered before, seed, 1 if orthographic, 1 if there is a previous frame
};
#endif
