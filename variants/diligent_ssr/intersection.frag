// One ray per pixel of the targets, and what it meets.
#include "tracer"
#include "common/inward_rays.glsl"
#include "core/shaders/gbuffer/environment.glsl"
#include "common/half.glsl"
#include "common/halton.h"
#include "common/motion.glsl"
#include "diligent_ssr/ray.glsl"

uniform sampler2D roughness, blue_noise, hit_color;
layout(location = 0) out vec4 ray_radiance;
layout(location = 1) out vec4 ray_direction;

const float mirror_roughness = 0.01;
const uint misses_see_environment = 1u;

// Pixel of a block of 2x2 that its ray stands for, in a pattern of 4x4 blocks that changes with no frame (DiligentFX).
// Bit 0: right, bit 1: lower; column by column of blocks.
const int pixel_of_block[16] = int[16](0, 1, 2, 3, 3, 2, 1, 0, 1, 0, 3, 2, 2, 3, 0, 1);

ivec2 pixel_of_ray(ivec2 ray) {
    if (!half_resolution) return ray;
    int place = pixel_of_block[4 * (ray.x & 3) + (ray.y & 3)];
    return min(2 * ray + ivec2(place & 1, place >> 1), ivec2(camera.extent.xy) - 1);
}

// The original's unprojection knows of no jitter.
vec3 origin_of(ivec2 pixel) {
    vec2 uv = (vec2(pixel) + 0.5) * camera.extent.zw;
    float device_depth = texelFetch(depth, pixel, 0).r;
    return hierarchy_unproject_jitter ? view_from_image(vec3(uv, device_depth)) : view_from_screen(uv, device_depth);
}

// Where the previous frame showed what this one shows at `uv`, a place on the image.
vec2 previous_uv(vec2 uv) { return uv - motion_at(ivec2(camera.extent.xy * uv)); }

vec2 image_uv(TraceEnd end) { return (end.position - camera.jitter.xy) * camera.extent.zw; }
ivec2 previous_pixel(TraceEnd end) { return ivec2(camera.extent.xy * previous_uv(image_uv(end))); }

// Hits fade out towards the border of the previous frame, too.
float confidence_before(TraceEnd end) {
    vec2 uv = image_uv(end);
    float fade = hierarchy_fade_at_border ? max(border_fade(uv), 1e-6) : 1.0;
    return end.confidence * min(border_fade(previous_uv(uv)) / fade, 1.0);
}

vec3 color_at(ivec2 pixel) {
    return is_on_screen(pixel) ? texelFetch(hit_color, pixel, 0).rgb : vec3(0.0);
}

void main() {
    ray_radiance = ray_direction = vec4(0.0);
    ivec2 ray = ivec2(gl_FragCoord.xy), pixel = pixel_of_ray(ray);
    float perceptual_roughness = texelFetch(roughness, pixel, 0).r;
    if (is_far_plane(texelFetch(depth, pixel, 0).r)) return;  // of a block that shows more than background
    vec3 vs_origin = origin_of(pixel);
    SampledRay sampled = sample_ray(view_direction(vs_origin), view_normal(pixel),
                                    perceptual_roughness * perceptual_roughness,
                                    texelFetch(blue_noise, ray & 127, 0).xy);
    vec3 vs_flat = view_geometric_normal(pixel);
    float random = random_point(uvec4(ray, camera.frame.xy)).x;
    TraceEnd end = trace(TraceRay(pixel, 0u, vs_origin, sampled.direction, vs_flat, random,
                                  perceptual_roughness < mirror_roughness));

    vec3 ws_direction = mat3(camera.world_from_view) * sampled.direction;
    bool is_inward = inward_rays > 0u && dot(ws_direction, texelFetch(geometric_normal, pixel, 0).xyz) <= 0.0;
    float confidence = is_inward || end.outcome != outcome_hit ? 0.0 : end.confidence;
    if (previous_frame && confidence > 0.0) confidence = confidence_before(end);
    vec3 hit = vec3(0.0);
    if (confidence > 0.0) hit = color_at(previous_frame ? previous_pixel(end) : end.pixel);
    if (is_inward && inward_rays == inward_rays_black)
        ray_radiance = vec4(0.0, 0.0, 0.0, 1.0);
    else if (misses == misses_see_environment)
        ray_radiance = vec4(mix(environment_along_ray(pixel, ws_direction), hit, confidence), 1.0);
    else
        ray_radiance = vec4(hit * (premultiply_confidence ? confidence : 1.0), confidence);
    ray_direction = vec4(ws_direction * end.distance, sampled.density);
    if (float_rays) return;
    ray_radiance = as_halves(ray_radiance);
    ray_direction = as_halves(ray_direction);
}
