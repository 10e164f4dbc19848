// The directions of a map's texels. Places are those of core/shaders/gbuffer/octahedral.glsl.
#ifndef SCREEN_PROBE_OCTAHEDRAL_MAP_GLSL
#define SCREEN_PROBE_OCTAHEDRAL_MAP_GLSL
#include "common/screen_probe/width.h"
#include "core/shaders/gbuffer/octahedral.glsl"

const int probe_width = int(screen_probe_width);

// Beyond an edge the map goes on as if turned by half about the edge's middle.
vec2 place_within(vec2 p) {
    if (abs(p.x) > 1.0) p = vec2(sign(p.x) * 2.0 - p.x, -p.y);
    if (abs(p.y) > 1.0) p = vec2(-p.x, sign(p.y) * 2.0 - p.y);
    return p;
}
#endif
