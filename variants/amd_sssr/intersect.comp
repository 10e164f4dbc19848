// Traces the listed rays and blends what they meet with the environment.
#extension GL_KHR_shader_subgroup_ballot : require
#include "amd_sssr/hit.glsl"
#include "amd_sssr/lists.glsl"
#include "amd_sssr/march.glsl"
#include "amd_sssr/reflection.glsl"
#include "common/inward_rays.glsl"
#include "core/shaders/gbuffer/environment.glsl"

layout(local_size_x = 64) in;
uniform sampler2D roughness, blue_noise, lit, fallback;
uniform writeonly image2D radiance, march_steps;

const uint misses_see_environment = 1u;

struct Traced {
    vec3 radiance;
    float ray_length;  // m
};

vec3 lit_at(vec2 uv) {
    ivec2 texel = ivec2(camera.extent.xy * uv);
    return is_on_screen(texel) ? texelFetch(lit, texel, 0).rgb : vec3(0.0);  // uv may be 1
}

Traced trace(ivec2 pixel) {
    float alpha = texelFetch(roughness, pixel, 0).r;
    bool shows_mirror = is_mirror(alpha);
    int finest = shows_mirror ? 0 : min(int(most_detailed_mip), textureQueryLevels(depth_pyramid) - 1);

    vec2 uv = (vec2(pixel) + 0.5) * camera.extent.zw;
    vec3 origin = vec3(uv, surface_depth(ivec2(uv * camera.extent.xy / float(1 << finest)), finest));
    vec3 vs_origin = view_from_image(origin);
    vec3 view = view_direction(vs_origin), vs_normal = view_normal(pixel);
    vec2 u = texelFetch(blue_noise, pixel & 127, 0).xy;
    vec3 direction = sample_reflection(pixel, view, vs_normal, alpha, shows_mirror, u);
    // Where a mirror's lobe has no direction (guard_mirror_normal) the original's ray, too, is a miss of length 0.
    bool is_nowhere = any(isnan(direction));
    if (is_nowhere) direction = reflect(view, vs_normal);
    bool is_inward = inward_rays > 0u && dot(direction, view_geometric_normal(pixel)) <= 0.0;
    if (is_inward && inward_rays == inward_rays_black) return Traced(vec3(0.0), 0.0);

    MarchEnd end = march_pyramid(screen_ray(origin, vs_origin, direction), finest, shows_mirror);
    vec3 vs_ray = view_from_image(end.position) - vs_origin;
    bool is_rejected = is_nowhere || is_inward || march == not_at_all || (reject_unfinished && end.is_unfinished);
    float confidence = is_rejected ? 0.0 : hit_confidence(origin, end.position, vs_ray, finest);
    vec3 hit = confidence > 0.0 ? lit_at(end.position.xy) : vec3(0.0);
    vec3 missed = misses == misses_see_environment
                      ? environment_along_ray(pixel, mat3(camera.world_from_view) * direction)
                      : texelFetch(fallback, pixel, 0).rgb;
    float distance = confidence > 0.0 || !far_misses ? length(vs_ray) : camera.depth.y;
    return Traced(mix(ibl_factor * missed, hit, confidence), is_nowhere || isnan(distance) ? 0.0 : distance);
}

void main() {
    uint index = (gl_WorkGroupID.y * gl_NumWorkGroups.x + gl_WorkGroupID.x) * 64u + gl_LocalInvocationIndex;
    if (index >= ray_count) return;
    uint ray = listed_ray[index];
    ivec2 pixel = pixel_of_ray(ray);
    Traced traced = trace(pixel);
    if (count_steps) imageStore(march_steps, pixel, vec4(float(steps_taken)));

    vec4 result = vec4(traced.radiance, traced.ray_length);
    imageStore(radiance, pixel, result);
    if ((ray & copy_horizontal) != 0u) imageStore(radiance, pixel ^ ivec2(1, 0), result);
    if ((ray & copy_vertical) != 0u) imageStore(radiance, pixel ^ ivec2(0, 1), result);
    if ((ray & copy_diagonal) != 0u) imageStore(radiance, pixel ^ ivec2(1, 1), result);
}
