// The rays of each traced pixel, for a denoiser.
#include "tracer"
#include "frostbite_sssr/horizon.glsl"
#include "frostbite_sssr/trace_ray.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

TraceEnd march(TraceRay ray) { return trace(ray); }

// Of mirror rays the density has no number; 1 says that there is a ray.
DrawnRay drawn_ray(ivec2 pixel, uint k, vec3 towards_surface) {
    if (draw_directions) return draw_ray(pixel, towards_surface, k, ray_dimension);
    return DrawnRay(reflect(towards_surface, view_normal(pixel)), 1.0, true);
}

void main() {
    ivec2 traced = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(traced, traced_extent()))) return;
    ivec2 pixel = traced_pixel(traced, camera.frame.x);
    bool has_rays = starts_rays(pixel);
    for (uint k = 0u; k < max_rays; ++k) {
        TracedRay ray = TracedRay(vec3(0.0), 0.0, ray_missed, 0.0, 0.0);
        if (has_rays) {
            vec3 origin = view_position(pixel), towards_surface = view_direction(origin);
            ray = traced_ray(pixel, k, ray_dimension, origin, drawn_ray(pixel, k, towards_surface));
            float mu_o = -dot(towards_surface, view_normal(pixel));
            if (draw_directions) ray.inverse_density *= redrawn_density_factor(mu_o, texelFetch(normal, pixel, 0).w);
        }
        store_ray(index_of_ray(traced, k), ray);
    }
}
