// One level of a depth hierarchy from the level below.
#include "diligent_ssr/footprint.glsl"
uniform sampler2D finer_depth;
layout(push_constant) uniform Source { int finer_level, keeps_farthest; };
layout(location = 0) out float kept_depth;

void main() {
    ivec2 finer_extent = textureSize(finer_depth, finer_level), first = 2 * ivec2(gl_FragCoord.xy);
    ivec2 count = footprint(finer_extent);
    bool keeps_larger = is_reversed() != (keeps_farthest == 1);
    float kept = keeps_larger ? 0.0 : 1.0;
    for (int y = 0; y < count.y; ++y)
        for (int x = 0; x < count.x; ++x) {
            float finer = texelFetch(finer_depth, min(first + ivec2(x, y), finer_extent - 1), finer_level).r;
            kept = keeps_larger ? max(kept, finer) : min(kept, finer);
        }
    kept_depth = kept;
}
