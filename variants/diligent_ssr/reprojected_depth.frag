// Device depth of the point that each pixel shows, as the previous camera saw it. Also of the background, as a point on
// the far plane.
#include "common/mirror_ray.glsl"
layout(location = 0) out float reprojected_depth;

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec3 ws_position =
        world_from_screen(screen_from_pixel(pixel) * camera.extent.zw, texelFetch(depth, pixel, 0).r);
    vec4 clip = camera.previous_clip_from_world * vec4(ws_position, 1.0);
    float near_plane = 1.0 - camera.depth.z;
    reprojected_depth = guard_previous_clip && clip.w <= 0.0 ? near_plane : clip.z / clip.w;
}
