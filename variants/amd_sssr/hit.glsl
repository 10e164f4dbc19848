// Whether the place where a ray ended shows what it would have met, and how surely.
#ifndef AMD_SSSR_HIT_GLSL
#define AMD_SSSR_HIT_GLSL
#include "amd_sssr/screen.glsl"

// The tested depth: of the level that the march ended on, or of the nearest of 2x2 pixels.
float surface_at(vec2 uv, int finest) {
    int level = thickness_at_hit_mip ? finest : 1;
    return surface_depth(ivec2(camera.extent.xy * uv) >> level, level);
}

bool is_own_pixel(vec2 origin, vec2 hit) {
    if (accept_contact_hits) return ivec2(camera.extent.xy * hit) == ivec2(camera.extent.xy * origin);
    return all(lessThan(abs(hit - origin), 2.0 * camera.extent.zw));
}

// Share of the hit's colour in the ray's; the rest is environment. `origin`, `hit`: image; `vs_ray`: from one to the
// other, view space.
float hit_confidence(vec3 origin, vec3 hit, vec3 vs_ray, int finest) {
    if (any(lessThan(hit.xy, vec2(0.0))) || any(greaterThan(hit.xy, vec2(1.0)))) return 0.0;
    if (is_own_pixel(origin.xy, hit.xy)) return 0.0;
    float surface = surface_at(hit.xy, finest);
    if (is_background(surface)) return 0.0;
    // A surface that is met from behind.
    vec3 ws_normal = texelFetch(normal, ivec2(camera.extent.xy * hit.xy), 0).xyz;
    if (dot(mat3(camera.view_from_world) * ws_normal, vs_ray) > 0.0) return 0.0;

    float miss = distance(view_from_image(vec3(hit.xy, surface)), view_from_image(hit));
    float closeness = 1.0 - smoothstep(0.0, depth_buffer_thickness, miss);
    float confidence = closeness * closeness * border_fade(hit.xy);
    return confidence > 0.0 ? confidence : 0.0;  // 0 for directions that are not a number, too
}
#endif
