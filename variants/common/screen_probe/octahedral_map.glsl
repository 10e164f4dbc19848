// Directions by texels: Cigolle et al. 2014, "A Survey of Efficient Representations for Independent Unit Vectors", JCGT
// 3(2), "oct". Places are in [-1, 1]^2.
#ifndef SCREEN_PROBE_OCTAHEDRAL_MAP_GLSL
#define SCREEN_PROBE_OCTAHEDRAL_MAP_GLSL
#include "common/screen_probe/width.h"
#include "core/shaders/gbuffer/octahedral.glsl"

const int probe_width = int(screen_probe_width);

vec3 direction_of_place(vec2 p) {
    vec3 n = vec3(p, 1.0 - abs(p.x) - abs(p.y));
    if (n.z < 0.0) n.xy = folded(n.xy);
    return normalize(n);
}

vec2 place_of_direction(vec3 n) {
    vec2 p = n.xy / (abs(n.x) + abs(n.y) + abs(n.z));
    return n.z < 0.0 ? folded(p) : p;
}

// Beyond an edge the map goes on as if turned by half about the edge's middle.
vec2 place_within(vec2 p) {
    if (abs(p.x) > 1.0) p = vec2(sign(p.x) * 2.0 - p.x, -p.y);
    if (abs(p.y) > 1.0) p = vec2(-p.x, sign(p.y) * 2.0 - p.y);
    return p;
}
#endif
