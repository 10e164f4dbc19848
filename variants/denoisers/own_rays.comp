// The mean of what a pixel's own rays see, weighed by the lobe of visible normals over their densities; mirror rays
// have no density and equal weights. With half_resolution the rays are those of the traced pixel of the same 2x2
// pixels.
#include "common/ggx_lobe.h"
#include "denoisers/seen.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
uniform writeonly image2D own_radiance, own_length;

float lobe_weight(vec3 o, mat3 view_from_local, float alpha, TracedRay ray) {
    if (!draw_directions) return 1.0;
    return lobe_density(lobe_of_visible_normals, o, ray.direction * view_from_local, alpha) * ray.inverse_density;
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (!is_on_screen(pixel)) return;
    vec4 known = vec4(0.0);  // of weight times confidence: radiance, 1
    vec2 lengths = vec2(0.0);
    float weight_sum = 0.0;
    if (reflects(pixel, max_roughness)) {
        mat3 view_from_local = basis_from_normal(view_normal(pixel));
        vec3 o = -view_direction(view_position(pixel)) * view_from_local;
        float alpha = ggx_alpha(texelFetch(normal, pixel, 0).w);
        for (uint k = 0u; k < max_rays; ++k) {
            TracedRay ray = load_ray(index_of_ray(traced_of_pixel(pixel), k));
            if (ray.inverse_density == 0.0 || ray.target == ray_below_horizon || o.z <= 0.0) continue;
            float weight = lobe_weight(o, view_from_local, alpha, ray);
            Seen seen = seen_by(pixel, ray);
            weight_sum += weight;
            known += weight * seen.confidence * vec4(seen.radiance, 1.0);
            if (is_hit(ray)) lengths += weight * vec2(ray.ray_length, 1.0);
        }
    }
    vec4 result = known.a > 0.0 ? vec4(known.rgb / known.a, min(known.a / weight_sum, 1.0)) : vec4(0.0);
    imageStore(own_radiance, pixel, result);
    imageStore(own_length, pixel, vec4(lengths.y > 0.0 ? lengths.x / lengths.y : 0.0));
}
