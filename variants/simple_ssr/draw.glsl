// Directions of rays, and how they are weighed.
#ifndef SIMPLE_SSR_DRAW_GLSL
#define SIMPLE_SSR_DRAW_GLSL
#include "common/ggx_lobe.h"
#include "common/halton.h"
#include "common/mirror_ray.glsl"

const uint draw_mirror = 0u, draw_jittered_ray = 1u, draw_normals = 2u, draw_visible_normals = 3u;  // parameter `draw`
const uint weights_ratio = 1u;                                                                      // parameter `weights`

struct DrawnRay {
    vec3 direction;  // view space, unit
    float weight;    // 0: below the horizon, not to be traced
};

// In the frame of the shading normal, +z; o: towards the viewer.
struct LocalRay {
    vec3 direction;
    float density;  // sr^-1, that it was drawn with
};

// The lobe of a view along the normal, its axis laid into the mirror direction.
LocalRay jittered_ray(vec3 o, float alpha, vec2 u) {
    vec3 axis = vec3(-o.xy, o.z);
    LobeSample drawn = sample_lobe(lobe_of_normals, vec3(0.0, 0.0, 1.0), alpha, 0.0, u);
    return LocalRay(basis_from_normal(axis) * drawn.direction, 1.0 / drawn.inverse_density);
}

LocalRay cosine_ray(vec2 u) {
    vec3 direction = sample_cosine(u);
    return LocalRay(direction, direction.z / pi);
}

LocalRay draw_locally(vec3 o, float alpha, vec2 u) {
    if (draw == draw_jittered_ray) return jittered_ray(o, alpha, u);
    if (draw != draw_normals && draw != draw_visible_normals) return cosine_ray(u);
    LobeSample drawn =
        sample_lobe(draw == draw_normals ? lobe_of_normals : lobe_of_visible_normals, o, alpha, 0.0, u);
    return LocalRay(drawn.direction, 1.0 / drawn.inverse_density);
}

// Of the lobe whose mean over directions is the `incident` radiance that techniques estimate.
float weight_of(LocalRay ray, vec3 o, float alpha) {
    if (weights != weights_ratio || draw == draw_visible_normals) return 1.0;
    return lobe_density(lobe_of_visible_normals, o, ray.direction, alpha) / ray.density;
}

// Ray k of a pixel, drawn again while it goes below the horizon.
DrawnRay draw_ray(ivec2 pixel, uint k) {
    vec3 towards_surface = view_direction(view_position(pixel)), n = view_normal(pixel);
    if (draw == draw_mirror) return DrawnRay(reflect(towards_surface, n), 1.0);
    mat3 view_from_local = basis_from_normal(n);
    vec3 o = -towards_surface * view_from_local;
    float alpha = ggx_alpha(texelFetch(normal, pixel, 0).w);
    for (uint attempt = 0u; attempt <= max_regenerations; ++attempt) {
        uvec4 key = uvec4(pixel, camera.frame.x, camera.frame.y << 9 | k << 5 | attempt);
        LocalRay ray = draw_locally(o, alpha, random_point(key));
        if (ray.direction.z > 0.0) return DrawnRay(view_from_local * ray.direction, weight_of(ray, o, alpha));
    }
    return DrawnRay(n, 0.0);
}
#endif
