// What each ray sees, once for all pixels that reuse it: the rays of a traced pixel lie side by side.
#include "resolves/ratio_filter/shown.glsl"
#include "resolves/seen.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
uniform writeonly image2D ray_seen;

void main() {
    ivec2 traced = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(traced, traced_extent()))) return;
    ivec2 pixel = traced_pixel(traced, camera.frame.x);
    for (uint k = 0u; k < max_rays; ++k) {
        TracedRay ray = load_ray(index_of_ray(traced, k));
        vec4 seen_color = vec4(0.0);
        if (ray.inverse_density != 0.0 && ray.target != ray_below_horizon) {
            Seen seen = seen_by(pixel, ray);
            seen_color = vec4(clamp(seen.radiance, 0.0, largest_radiance), seen.confidence);
        }
        imageStore(ray_seen, ivec2(traced.x * int(max_rays) + int(k), traced.y), seen_color);
    }
}
