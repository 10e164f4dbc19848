// Positions on the screen as the march uses them: uv of the G-buffer's images, whose texels hold what the samples saw,
// and device depth. With TAA jitter the samples lie beside the pixel centres, and so does this screen.
#ifndef AMD_SSSR_SCREEN_GLSL
#define AMD_SSSR_SCREEN_GLSL
#include "common/mirror_ray.glsl"

uniform sampler2D depth_pyramid;

vec2 jitter_uv() { return camera.jitter.xy * camera.extent.zw; }

vec3 image_from_view(vec3 vs_position) { return screen_from_view(vs_position) - vec3(jitter_uv(), 0.0); }
vec3 view_from_image(vec3 position) { return view_from_screen(position.xy + jitter_uv(), position.z); }

bool is_reversed() { return camera.depth.w == 1.0; }
bool is_farther(float a, float b) { return is_reversed() ? a < b : a > b; }

// The nearest surface in a texel of the pyramid. Texels that a level lacks, on and off the screen, are 0, as reads
// beyond an image are in the original: the near plane, from which rays descend to the next finer level; but the far
// plane with reversed depth. Mended, they are the near plane always.
float surface_depth(ivec2 texel, int level) {
    bool exists = all(greaterThanEqual(texel, ivec2(0))) &&
                  all(lessThan(texel, max(ivec2(camera.extent.xy) >> level, ivec2(1))));
    if (!exists) return stop_outside_screen ? 1.0 - camera.depth.z : 0.0;
    return texelFetch(depth_pyramid, texel, level).r;
}
#endif
