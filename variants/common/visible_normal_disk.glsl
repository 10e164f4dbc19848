#ifndef COMMON_VISIBLE_NORMAL_DISK_GLSL
#define COMMON_VISIBLE_NORMAL_DISK_GLSL
#include "core/shared/brdf.h"

// A visible micro-normal about +z: Heitz 2018, "Sampling the GGX Distribution of Visible Normals", JCGT 7(4), for one
// alpha. SSSR 1.5's own mapping of random numbers, kept so that its noise gives its rays; DiligentFX's document prints it,
// too.
vec3 sample_visible_normal(vec3 o, float alpha, vec2 u) {
    vec3 v = normalize(vec3(alpha * o.xy, o.z));
    float across = dot(v.xy, v.xy);
    vec3 t1 = across > 0.0 ? vec3(-v.y, v.x, 0.0) * inversesqrt(across) : vec3(1.0, 0.0, 0.0);
    vec3 t2 = cross(v, t1);
    float r = sqrt(u.x), phi = 2.0 * pi * u.y;
    float p1 = r * cos(phi), s = 0.5 * (1.0 + v.z);
    float p2 = mix(sqrt(1.0 - p1 * p1), r * sin(phi), s);
    vec3 n = p1 * t1 + p2 * t2 + sqrt(max(0.0, 1.0 - p1 * p1 - p2 * p2)) * v;
    return normalize(vec3(alpha * n.xy, max(0.0, n.z)));
}
#endif
