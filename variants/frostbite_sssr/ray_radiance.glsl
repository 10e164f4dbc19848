// What a reused ray sees.
#ifndef FROSTBITE_SSSR_RAY_RADIANCE_GLSL
#define FROSTBITE_SSSR_RAY_RADIANCE_GLSL
#include "core/shaders/gbuffer/environment.glsl"
#include "frostbite_sssr/lobe_cone.h"
#include "frostbite_sssr/reuse.glsl"
#include "denoisers/pixel_scale.glsl"

uniform sampler2D color_pyramid;

// Tangent of half the angle of the cone that one ray stands for.
float cone_tangent(Surface surface) {
    const bool is_published = grazing_cone == 0u, is_of_lobe = grazing_cone == 1u;
    float alpha = surface.roughness * surface.roughness;  // not ggx_alpha(): mirrors are not blurred
    float tangent = cone_scale * lobe_cone_tangent(alpha, importance_bias);
    if (is_published) return tangent * mix(clamp(2.0 * surface.o.z, 0.0, 1.0), 1.0, sqrt(surface.roughness));
    return is_of_lobe ? tangent * lobe_cone_narrowing(surface.o.z) : tangent;
}

// A texel of level n stands for 2^n pixels, and reading it between texels widens it to twice as many.
float color_level(Surface surface, OwnRay own) {
    if (!filtered_sampling) return 0.0;
    vec3 position = surface.position + own.ray_length * own.direction;
    float diameter = 2.0 * own.ray_length * cone_tangent(surface) * pixels_per_metre(position);
    return log2(max(diameter, 2.0)) - 1.0;
}

struct Seen {
    vec3 radiance;
    float confidence;  // share of it that is known
};

Seen seen_along(ivec2 pixel, Surface surface, ReusedRay ray, OwnRay own) {
    const bool misses_see_environment = misses == 1u;
    float confidence = is_hit(ray.traced) ? ray.traced.confidence : 0.0;
    vec3 hit = vec3(0.0);
    if (confidence > 0.0) hit = textureLod(color_pyramid, ray.color_uv, color_level(surface, own)).rgb;
    if (!misses_see_environment) return Seen(hit, confidence);
    vec3 environment = environment_along_ray(pixel, mat3(camera.world_from_view) * own.direction);
    return Seen(mix(environment, hit, confidence), 1.0);
}
#endif
