// A listed ray, from its draw to its stored result. The including file decides how it marches.
#ifndef FROSTBITE_SSSR_TRACE_LISTED_GLSL
#define FROSTBITE_SSSR_TRACE_LISTED_GLSL
#include "frostbite_sssr/horizon.glsl"
#include "frostbite_sssr/trace_ray.glsl"

void trace_listed(uint index) {
    ivec2 pixel = traced_pixel(traced_of_ray(index), camera.frame.x);
    TracedRay ray = trace_ray(pixel, index % max_rays, ray_dimension);
    float mu_o = -dot(view_direction(view_position(pixel)), view_normal(pixel));
    ray.inverse_density *= redrawn_density_factor(mu_o, texelFetch(normal, pixel, 0).w);
    store_ray(index, ray);
}
#endif
