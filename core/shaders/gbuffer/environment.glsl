// The environment of the scene, sharp and prefiltered; the C++ side is core/gbuffer/environment_images.h.
#include "core/shaders/gbuffer/environment_kind.glsl"
#include "core/shared/brdf.h"
#include "core/shared/environment.h"
#include "core/shared/prefiltered_environment.h"

layout(push_constant) uniform EnvironmentConstants {
    uint environment_type;     // see is_environment()
    float environment_rotation;
    vec4 environment_color, environment_slope, environment_axis;
};
uniform sampler2D environment;
uniform sampler2D prefiltered_environment;

// True for the type: 0: constant, 1: gradient, 2: image, 3: per pixel, from a file. A pass that says which (environment_kind.glsl) has it
// compiled in: the branches of the others cost time in every ray though none takes them.
bool is_environment(uint type) { return environment_kind == any_environment ? environment_type == type : environment_kind == type; }

// A texel of the environment's image, which goes on around in x.
vec3 environment_texel(int x, int y, ivec2 size) {
    return texelFetch(environment, ivec2((x + size.x) % size.x, clamp(y, 0, size.y - 1)), 0).rgb;
}

// Radiance that arrives from `direction`: Environment::radiance().
vec3 environment_radiance(vec3 direction) {
    if (is_environment(0u)) return environment_color.rgb;
    if (is_environment(1u)) return max(environment_color.rgb + environment_slope.rgb * dot(direction, environment_axis.xyz), vec3(0.0));
    ivec2 size = textureSize(environment, 0);
    vec2 p = environment_uv(direction, environment_rotation) * vec2(size) - 0.5;
    int x = int(floor(p.x));
    int y = int(floor(p.y));
    vec2 f = p - floor(p);
    vec3 top = mix(environment_texel(x, y, size), environment_texel(x + 1, y, size), f.x);
    vec3 bottom = mix(environment_texel(x, y + 1, size), environment_texel(x + 1, y + 1, size), f.x);
    return mix(top, bottom, f.y);
}

// Radiance that a ray of the pixel sees if it meets nothing; `direction`: world space, unit.
vec3 environment_along_ray(ivec2 pixel, vec3 direction) {
    if (!scene_has_environment) return vec3(0.0);
    return is_environment(3u) ? texelFetch(environment, pixel, 0).rgb : environment_radiance(direction);
}

// Radiance from a direction, blurred as one level of the prefiltered environment.
vec3 prefiltered_level(uint level, vec3 direction) {
    PrefilterTap tap = prefilter_tap(level, environment_uv(direction, 0.0));
    vec3 top = mix(texelFetch(prefiltered_environment, ivec2(tap.columns.x, tap.rows.x), 0).rgb,
                   texelFetch(prefiltered_environment, ivec2(tap.columns.y, tap.rows.x), 0).rgb, tap.fraction.x);
    vec3 bottom = mix(texelFetch(prefiltered_environment, ivec2(tap.columns.x, tap.rows.y), 0).rgb,
                      texelFetch(prefiltered_environment, ivec2(tap.columns.y, tap.rows.y), 0).rgb, tap.fraction.x);
    return mix(top, bottom, tap.fraction.y);
}

// Mean radiance over a specular lobe about a direction: mean_over_lobe() of core/gbuffer/prefiltered_environment.h.
vec3 mean_over_lobe(vec3 direction, float roughness) {
    if (environment_type == 0u) return environment_color.rgb;
    PrefilterBlend blend = prefilter_blend(roughness);
    vec3 sharp = blend.level == 0u ? environment_radiance(direction) : prefiltered_level(blend.level, direction);
    return mix(sharp, prefiltered_level(blend.level + 1u, direction), blend.fraction);
}

// Unoccluded irradiance / pi on a surface with the unit normal n.
vec3 environment_irradiance_over_pi(vec3 n) {
    return environment_type == 0u ? environment_color.rgb : prefiltered_level(prefilter_irradiance_level, n);
}
