// One level of a depth hierarchy from the level below.
#include "diligent_ssr/footprint.glsl"
uniform sampler2D finer_depth;
layout(push_constant) uniform Source { int finer_level, keeps_farthest; };
layout(location = 0) out float kept_depth;

void main() {
    ivec2 finer_extent = textureSize(finer_depth, finer_level), first = 2 * ivec2(gl_FragCoord.xy);
    ivec2 count = footprint(finer_extent);
    float kept = keeps_farthest == 1 ? 1.0 - camera.depth.z : camera.depth.z;
    for (int y = 0; y < count.y; ++y)
        for (int x = 0; x < count.x; ++x) {
            float finer = texelFetch(finer_depth, min(first + ivec2(x, y), finer_extent - 1), finer_level).r;
            kept = keeps_farthest == 1 ? farther_of(kept, finer) : nearer_of(kept, finer);
        }
    kept_depth = kept;
}
