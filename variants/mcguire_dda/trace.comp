// Writes `hit`: uv (un-jittered screen) of the point that each pixel's mirror ray meets, its distance (m), confidence
// (0: no hit).
#include "tracer"
#include "common/halton.h"

layout(local_size_x = 8, local_size_y = 8) in;
uniform writeonly image2D hit;

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (!is_on_screen(pixel)) return;
    vec4 result = vec4(0.0);
    if (reflects(pixel, max_roughness)) {
        Ray ray = mirror_ray(pixel);
        vec3 vs_normal = view_geometric_normal(pixel);
        float random = random_point(uvec4(pixel, camera.frame.xy)).x;
        if (trace_inward_rays || dot(ray.direction, vs_normal) > 0.0) {
            TraceEnd end = trace(TraceRay(pixel, 0u, ray.origin, ray.direction, vs_normal, random, true));
            // On the border between two pixels, or where a step ended beside the hit, the pixel that was met decides.
            if (pixel_from_screen(end.position) != end.pixel) end.position = screen_from_pixel(end.pixel);
            if (end.outcome == outcome_hit) result = vec4(end.position * camera.extent.zw, end.distance, end.confidence);
        }
    }
    imageStore(hit, pixel, result);
}
