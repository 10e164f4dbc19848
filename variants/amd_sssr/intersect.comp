// Traces the listed rays and blends what they meet with the environment.
#include "tracer"
#include "amd_sssr/lists.glsl"
#include "amd_sssr/reflection.glsl"
#include "common/inward_rays.glsl"
#include "core/shaders/gbuffer/environment.glsl"

layout(local_size_x = 64) in;
uniform sampler2D roughness, blue_noise, lit, fallback;
uniform writeonly image2D radiance;

const uint misses_see_environment = 1u;

struct Traced {
    vec3 radiance;
    float ray_length;  // m
};

vec3 lit_at(ivec2 pixel) {
    return is_on_screen(pixel) ? texelFetch(lit, pixel, 0).rgb : vec3(0.0);  // a hit may lie on the border
}

Traced traced_ray(ivec2 pixel) {
    float alpha = texelFetch(roughness, pixel, 0).r;
    bool shows_mirror = is_mirror(alpha);
    vec2 uv = (vec2(pixel) + 0.5) * camera.extent.zw;
    vec3 vs_origin = view_from_image(vec3(uv, texelFetch(depth, pixel, 0).r));
    vec3 view = view_direction(vs_origin), vs_normal = view_normal(pixel), vs_flat = view_geometric_normal(pixel);
    vec2 u = texelFetch(blue_noise, pixel & 127, 0).xy;
    vec3 direction = sample_reflection(pixel, view, vs_normal, alpha, shows_mirror, u);
    // Where a mirror's lobe has no direction (guard_mirror_normal) the original's ray, too, is a miss of length 0.
    bool is_nowhere = any(isnan(direction));
    if (is_nowhere) direction = reflect(view, vs_normal);
    bool is_inward = inward_rays > 0u && dot(direction, vs_flat) <= 0.0;
    if (is_inward && inward_rays == inward_rays_black) return Traced(vec3(0.0), 0.0);

    TraceEnd end = trace(TraceRay(pixel, 0u, vs_origin, direction, vs_flat, march_random(pixel), shows_mirror));
    float confidence = is_nowhere || is_inward ? 0.0 : end.confidence;
    vec3 hit = confidence > 0.0 ? lit_at(end.pixel) : vec3(0.0);
    vec3 seen_by_misses = misses == misses_see_environment
                      ? environment_along_ray(pixel, mat3(camera.world_from_view) * direction)
                      : texelFetch(fallback, pixel, 0).rgb;
    float distance = confidence > 0.0 || !far_misses ? end.distance : camera.depth.y;
    return Traced(mix(ibl_factor * seen_by_misses, hit, confidence), is_nowhere || isnan(distance) ? 0.0 : distance);
}

void main() {
    uint index = (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * 64u + gl_LocalInvocationIndex;
    if (index >= ray_count) return;
    uint ray = listed_ray[index];
    ivec2 pixel = pixel_of_ray(ray);
    Traced traced = traced_ray(pixel);

    vec4 result = vec4(traced.radiance, traced.ray_length);
    imageStore(radiance, pixel, result);
    if ((ray & copy_horizontal) != 0u) imageStore(radiance, pixel ^ ivec2(1, 0), result);
    if ((ray & copy_vertical) != 0u) imageStore(radiance, pixel ^ ivec2(0, 1), result);
    if ((ray & copy_diagonal) != 0u) imageStore(radiance, pixel ^ ivec2(1, 1), result);
}
