// Emission and direct diffuse light without any shadow; the environment in the background. Diffuse light of the
// environment takes the dielectric's Fresnel loss at normal incidence: at grazing view it is up to 2.5 % too bright.
#include "core/shaders/gbuffer/dielectric_f0.glsl"
#include "core/shaders/gbuffer/environment.glsl"
#include "core/shaders/gbuffer/pixel.glsl"
#include "core/shared/drawn_light.h"
#include "core/shared/punctual_light.h"
layout(local_size_x = 8, local_size_y = 8) in;

layout(std430) readonly buffer Lights { DrawnLight lights[]; };
layout(std430) readonly buffer LightCount { uint light_count; };
uniform sampler2D depth;
uniform sampler2D geometric_normal;
uniform sampler2D normal;
uniform sampler2D base_color;
uniform sampler2D emission;
layout(rgba32f) uniform writeonly image2D lit;

// Unit direction to the light, and the irradiance at normal incidence.
vec3 to_light(DrawnLight light, vec3 ws_position, out vec3 irradiance) {
    irradiance = light.intensity_type.rgb;
    if (light.intensity_type.w == 0.0) return -light.direction_outer.xyz;
    vec3 towards = light.position_range.xyz - ws_position;
    float distance_to_light = length(towards);
    towards /= distance_to_light;
    irradiance *= punctual_falloff(distance_to_light, light.position_range.w);
    if (light.intensity_type.w == 2.0)
        irradiance *= spot_attenuation(dot(light.direction_outer.xyz, -towards), light.inner_cone.x, light.direction_outer.w);
    return towards;
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(pixel, imageSize(lit)))) return;
    float device_depth = texelFetch(depth, pixel, 0).r;
    vec3 ws_direction = ws_pixel_direction(pixel);
    if (is_background(device_depth)) {
        imageStore(lit, pixel, vec4(environment_radiance(ws_direction), 0.0));
        return;
    }
    vec3 n = texelFetch(normal, pixel, 0).xyz;
    vec3 g = texelFetch(geometric_normal, pixel, 0).xyz;
    vec4 color_metalness = texelFetch(base_color, pixel, 0);
    vec4 emitted_specular = texelFetch(emission, pixel, 0);
    vec3 ws_position = world_from_screen(sample_uv(pixel), device_depth);
    vec3 own_f0 = dielectric_f0_at(pixel);  // the diffuse light lacks the most that any colour reflects
    float f0 = max(own_f0.r, max(own_f0.g, own_f0.b)) * emitted_specular.w;

    vec3 light_sum = (1.0 - f0) * environment_irradiance_over_pi(n);
    for (uint i = 0u; i < light_count; ++i) {
        vec3 irradiance;
        vec3 towards = to_light(lights[i], ws_position, irradiance);
        float mu_i = dot(n, towards);
        if (mu_i <= 0.0 || dot(g, towards) <= 0.0) continue;
        float fresnel = mix(f0, emitted_specular.w, schlick_weight(dot(towards, normalize(towards - ws_direction))));
        light_sum += (1.0 - fresnel) / pi * mu_i * irradiance;
    }
    vec3 diffuse = (1.0 - color_metalness.w) * color_metalness.rgb * light_sum;
    imageStore(lit, pixel, vec4(emitted_specular.rgb + diffuse, 0.0));
}
