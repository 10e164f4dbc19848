// Writes `traced`: the mean of what each pixel's rays hit, and the share of rays that hit something, both weighted.
#include "tracer"
#include "common/motion.glsl"
#include "simple_ssr/draw.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
uniform sampler2D shown_lit;
uniform writeonly image2D traced;

// At the pixel that was met, or where its surface was in the frame before.
vec3 lit_at(TraceEnd end) {
    vec2 uv = end.position * camera.extent.zw;
    bool lies_in_pixel = pixel_from_screen(end.position) == end.pixel;
    if (!previous_frame) return texelFetch(shown_lit, end.pixel, 0).rgb;
    if (!lies_in_pixel) uv = screen_from_pixel(end.pixel) * camera.extent.zw;
    vec2 uv_before = uv - motion_at(end.pixel);
    ivec2 texel = ivec2(floor(uv_before * camera.extent.xy - camera.jitter.zw));
    return texelFetch(shown_lit, clamp(texel, ivec2(0), ivec2(camera.extent.xy) - 1), 0).rgb;
}

bool starts_rays(ivec2 pixel) {
    if (!reflects(pixel, max_roughness)) return false;
    float mu_o = -dot(view_direction(view_position(pixel)), view_normal(pixel));
    return mu_o > 0.0 && !(rule_of_45_degrees && mu_o > sqrt(0.5));
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (!is_on_screen(pixel)) return;
    vec4 sum = vec4(0.0);  // of weight * confidence: radiance, 1
    float weight_sum = 0.0;
    if (starts_rays(pixel)) {
        vec3 origin = view_position(pixel), vs_normal = view_geometric_normal(pixel);
        bool is_mirror = draw == draw_mirror;
        for (uint k = 0u; k < (is_mirror ? 1u : rays); ++k) {
            DrawnRay drawn = draw_ray(pixel, k);
            if (!(drawn.weight > 0.0)) continue;
            float random = random_point(uvec4(pixel, camera.frame.x, camera.frame.y << 9 | k << 5 | 31u)).x;
            TraceEnd end = trace(TraceRay(pixel, k, origin, drawn.direction, vs_normal, random, is_mirror));
            weight_sum += drawn.weight;
            if (end.outcome == outcome_hit) sum += drawn.weight * end.confidence * vec4(lit_at(end), 1.0);
        }
    }
    vec4 result = vec4(0.0);
    if (sum.a > 0.0) result = vec4(sum.rgb / sum.a, min(sum.a / weight_sum, 1.0));
    imageStore(traced, pixel, result);
}
