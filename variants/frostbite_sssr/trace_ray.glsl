// One ray from its draw to its end. Whoever includes this says how it marches.
#ifndef FROSTBITE_SSSR_TRACE_RAY_GLSL
#define FROSTBITE_SSSR_TRACE_RAY_GLSL
#include "frostbite_sssr/draw_ray.glsl"
#include "frostbite_sssr/ray.glsl"
#include "frostbite_sssr/solid.glsl"

// To be defined. `random` in [0, 1).
March march(ScreenLine line, float random);

// Ray k of a pixel that starts rays.
TracedRay trace_ray(ivec2 pixel, uint k, uint first_dimension) {
    vec3 origin = view_position(pixel), vs_normal = view_geometric_normal(pixel);
    DrawnRay drawn = draw_ray(pixel, view_direction(origin), k, first_dimension);
    TracedRay ray = TracedRay(drawn.direction, drawn.inverse_density, ray_missed, 0.0, 0.0);
    if (!drawn.is_above_horizon) {
        ray.target = ray_below_horizon;
    } else if (dot(drawn.direction, vs_normal) <= 0.0) {
        ray.target = ray_into_surface;
    } else {
        ScreenLine line = screen_line(pixel, origin, drawn.direction, vs_normal);
        March end = march(line, random_pair(pixel, k, first_dimension + march_dimension).x);
        // Behind what it shows from the other side, the screen knows of nothing that the ray could go on to.
        bool is_seen = !front_faces_only || dot(drawn.direction, view_geometric_normal(end.pixel)) < 0.0;
        if (end.is_hit && is_seen) {
            ray.target = packed_pixel(end.pixel);
            ray.ray_length = distance_at(line, end.t);
            ray.confidence = 1.0;
        }
    }
    return ray;
}
#endif
