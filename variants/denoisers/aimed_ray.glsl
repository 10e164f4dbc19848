// A ray of another pixel as one pixel would trace it.
#ifndef DENOISERS_AIMED_RAY_GLSL
#define DENOISERS_AIMED_RAY_GLSL
#include "denoisers/ray.glsl"

struct AimedRay {
    vec3 direction;    // view space, unit
    float ray_length;  // m
};

// Of a ray that hit something, towards what it hit. `offset`: from the pixel's surface to where the ray started (view
// space, m). In this order the pixel's own ray keeps its direction to the last bits, as narrow lobes need.
AimedRay aimed_at_hit(vec3 offset, TracedRay ray) {
    vec3 to_hit = offset + ray.ray_length * ray.direction;
    float to_hit_length = length(to_hit);
    if (to_hit_length == 0.0) return AimedRay(ray.direction, ray.ray_length);
    return AimedRay(to_hit / to_hit_length, to_hit_length);
}
#endif
