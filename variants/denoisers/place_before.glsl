// Places on the previous frame's images.
#ifndef DENOISERS_PLACE_BEFORE_GLSL
#define DENOISERS_PLACE_BEFORE_GLSL
#include "common/mirror_ray.glsl"
#include "common/motion.glsl"

struct Place {
    vec2 position;  // pixels
    bool is_known;  // and before the camera
};

vec2 image_position(vec2 uv) { return uv * camera.extent.xy - camera.jitter.zw; }

vec2 surface_before(ivec2 pixel) {
    return image_position(screen_from_pixel(pixel) * camera.extent.zw - motion_at(pixel));
}

// Of something that stands still: a view-space position, or with w = 0 a direction.
Place place_before(vec4 vs_position) {
    vec4 clip = camera.previous_clip_from_world * (camera.world_from_view * vs_position);
    return Place(image_position(clip.xy / clip.w * 0.5 + 0.5), clip.w > 0.0);
}
#endif
