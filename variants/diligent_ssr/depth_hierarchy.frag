// One level of the depth hierarchy from the level below.
#include "diligent_ssr/footprint.glsl"
uniform sampler2D finer_depth;
layout(push_constant) uniform Source { int finer_level; };
layout(location = 0) out float nearest_depth;

void main() {
    ivec2 finer_extent = textureSize(finer_depth, finer_level), first = 2 * ivec2(gl_FragCoord.xy);
    ivec2 count = footprint(finer_extent);
    float nearest = camera.depth.z;
    for (int y = 0; y < count.y; ++y)
        for (int x = 0; x < count.x; ++x) {
            ivec2 texel = min(first + ivec2(x, y), finer_extent - 1);
            nearest = nearer(nearest, texelFetch(finer_depth, texel, finer_level).r);
        }
    nearest_depth = nearest;
}
