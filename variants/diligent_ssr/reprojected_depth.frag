// Device depth, in the previous camera, of the point that each pixel shows. Background is a point on the far plane.
#include "common/mirror_ray.glsl"
layout(location = 0) out float reprojected_depth;

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec2 ndc = screen_from_pixel(pixel) * camera.extent.zw * 2.0 - 1.0;
    vec4 clip = camera.previous_clip_from_world *
                (camera.world_from_clip * vec4(ndc, texelFetch(depth, pixel, 0).r, 1.0));
    float near_plane = 1.0 - camera.depth.z;
    reprojected_depth = guard_previous_clip && clip.w <= 0.0 ? near_plane : clip.z / clip.w;
}
