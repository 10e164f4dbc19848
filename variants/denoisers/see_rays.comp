// Finds what each ray sees, once for all pixels that reuse the ray.
#include "denoisers/seen.glsl"
#include "denoisers/seen_rays.glsl"

layout(local_size_x = 8, local_size_y = 8) in;

bool is_radiance(vec3 color) {
    return !any(isnan(color)) && !any(isinf(color)) && all(greaterThanEqual(color, vec3(0.0)));
}

void main() {
    ivec2 traced = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(traced, traced_extent()))) return;
    ivec2 pixel = traced_pixel(traced, camera.frame.x);
    for (uint k = 0u; k < max_rays; ++k) {
        TracedRay ray = load_ray(index_of_ray(traced, k));
        Seen seen = Seen(vec3(0.0), 0.0);
        if (ray.inverse_density != 0.0 && ray.target != ray_below_horizon) seen = seen_by(pixel, ray);
        vec3 radiance = is_radiance(seen.radiance) ? seen.radiance : vec3(0.0);
        seen_by_ray[index_of_ray(traced, k)] = vec4(radiance, seen.confidence);
    }
}
