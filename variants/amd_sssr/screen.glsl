// What the march reads of the depth pyramid.
#ifndef AMD_SSSR_SCREEN_GLSL
#define AMD_SSSR_SCREEN_GLSL
#include "common/image_space.glsl"
#include "common/mirror_ray.glsl"

uniform sampler2D depth_pyramid;

// The nearest surface in a texel of the pyramid. Texels that a level lacks, on and off the screen, are 0, as reads
// beyond an image are in the original: the near plane, from which rays descend to the next finer level; but the far
// plane with reversed depth. Mended, those on the screen are the near plane always.
float surface_depth(ivec2 texel, int level) {
    ivec2 extent = ivec2(camera.extent.xy);
    bool is_positive = all(greaterThanEqual(texel, ivec2(0)));
    if (is_positive && all(lessThan(texel, max(extent >> level, ivec2(1)))))
        return texelFetch(depth_pyramid, texel, level).r;
    bool shows_pixels = is_positive && all(lessThan(texel << level, extent));
    return refine_partial_texels && shows_pixels ? 1.0 - camera.depth.z : 0.0;
}
#endif
