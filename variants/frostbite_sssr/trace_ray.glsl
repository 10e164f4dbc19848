// One ray from its draw to its end.
#ifndef FROSTBITE_SSSR_TRACE_RAY_GLSL
#define FROSTBITE_SSSR_TRACE_RAY_GLSL
#include "frostbite_sssr/draw_ray.glsl"
#include "denoisers/ray.glsl"

// To be defined by whoever includes this, which says how it marches.
TraceEnd march(TraceRay ray);

// Ray k of a pixel that starts rays.
TracedRay traced_ray(ivec2 pixel, uint k, uint first_dimension, vec3 origin, DrawnRay drawn) {
    vec3 vs_normal = view_geometric_normal(pixel);
    TracedRay ray = TracedRay(drawn.direction, drawn.inverse_density, ray_missed, 0.0, 0.0);
    if (!drawn.is_above_horizon) {
        ray.target = ray_below_horizon;
    } else if (dot(drawn.direction, vs_normal) <= 0.0) {
        ray.target = ray_into_surface;
    } else {
        float random = random_pair(pixel, k, first_dimension + march_dimension).x;
        bool is_mirror = texelFetch(normal, pixel, 0).w == 0.0;
        TraceEnd end = march(TraceRay(pixel, k, origin, drawn.direction, vs_normal, random, is_mirror));
        if (end.outcome == outcome_hit) {
            ray.target = packed_pixel(end.pixel);
            ray.ray_length = end.distance;
            ray.confidence = end.confidence;
        }
    }
    return ray;
}

TracedRay trace_ray(ivec2 pixel, uint k, uint first_dimension) {
    vec3 origin = view_position(pixel);
    return traced_ray(pixel, k, first_dimension, origin, draw_ray(pixel, view_direction(origin), k, first_dimension));
}
#endif
