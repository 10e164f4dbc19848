// Whether the place where a ray ended shows what it would have met, and how surely.
#ifndef DILIGENT_SSR_HIT_GLSL
#define DILIGENT_SSR_HIT_GLSL
#include "common/mirror_ray.glsl"
#include "diligent_ssr/background.glsl"
#include "diligent_ssr/march.glsl"

uniform sampler2D motion;

bool is_near_origin(vec2 origin, vec2 hit) {
    if (accept_contact_hits) return ivec2(camera.extent.xy * hit) == ivec2(camera.extent.xy * origin);
    return all(lessThan(abs(hit - origin), 2.0 * camera.extent.zw));
}

// Where the previous frame showed what this one shows at `uv`, a place on the screen.
vec2 previous_uv(vec2 uv) { return uv - texelFetch(motion, ivec2(camera.extent.xy * uv), 0).xy; }

// Share of the hit's colour in what the ray sees. `origin`, `hit`: image; `ws_ray`: from one to the other.
float hit_confidence(vec3 origin, vec3 hit, vec3 ws_ray) {
    if (is_outside(hit.xy) || is_near_origin(origin.xy, hit.xy)) return 0.0;
    ivec2 pixel = ivec2(camera.extent.xy * hit.xy);
    float surface = surface_depth(pixel, 0);
    if (is_far_plane(surface)) return 0.0;
    bool is_met_from_behind = dot(texelFetch(normal, pixel, 0).xyz, ws_ray) > 0.0;
    if (is_met_from_behind) return 0.0;

    vec3 vs_surface = view_from_march(vec3(hit.xy, surface));
    float miss = distance(vs_surface, view_from_march(hit)) / (-vs_surface.z + 5.96e-8);
    float closeness = 1.0 - smoothstep(0.0, relative_depth_buffer_thickness, miss);
    float fade = border_fade(hit.xy);
    if (previous_frame) fade = min(fade, border_fade(previous_uv(hit.xy)));
    float confidence = closeness * closeness * fade;
    return confidence > 0.0 ? confidence : 0.0;  // 0 for directions that are not a number, too
}
#endif
