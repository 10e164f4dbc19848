// The direction of a pixel's ray, drawn from the visible normals of its GGX lobe.
#ifndef AMD_SSSR_REFLECTION_GLSL
#define AMD_SSSR_REFLECTION_GLSL
#include "common/halton.h"
#include "common/visible_normal_disk.glsl"
#include "core/shared/brdf.h"

const uint jitter_ray = 1u;  // parameter `jitter`

// Columns: two tangents and the normal. The original's choice of tangents decides which ray a random number gives.
mat3 basis_about(vec3 n) {
    vec3 u = abs(n.z) > 0.0 ? vec3(0.0, -n.z, n.y) / length(n.yz) : vec3(n.y, -n.x, 0.0) / length(n.xy);
    return mat3(u, cross(n, u), n);
}

// Independent numbers in [0, 1) for each pixel, frame, seed and attempt.
vec2 redraw(ivec2 pixel, uint attempt) {
    return random_point(uvec4(pixel, camera.frame.x, camera.frame.y * 16u + attempt));
}

// Of the start of its march, for tracers that take steps.
float march_random(ivec2 pixel) { return redraw(pixel, 15u).x; }

// About +z. Of the bounded lobe at most one in thirty directions is below the horizon, so that attempts do not run out.
vec3 sample_above_horizon(vec3 o, float alpha, vec2 u, ivec2 pixel) {
    float bound = ggx_cap_bound(o.z, alpha);
    vec3 i = vec3(0.0);
    for (uint attempt = 0u; attempt < 8u; ++attempt) {
        i = reflect(-o, sample_ggx_normal(o, alpha, u, bound));
        if (i.z > 0.0) break;
        u = redraw(pixel, attempt);
    }
    return i;
}

// About the mirror direction `axis`, as wide as the lobe of a view along the normal; the random numbers as above.
vec3 jittered_about(vec3 axis, float alpha, vec2 u) {
    vec3 m = sample_visible_normal(vec3(0.0, 0.0, 1.0), alpha, u);
    return basis_about(axis) * reflect(vec3(0.0, 0.0, -1.0), m);
}

// `towards_surface`, `n` and the result: view space, unit. `u`: of the blue noise.
vec3 sample_reflection(ivec2 pixel, vec3 towards_surface, vec3 n, float alpha, bool is_mirror, vec2 u) {
    if (!draw_directions || (guard_mirror_normal && is_mirror)) return reflect(towards_surface, n);
    if (jitter == jitter_ray) return jittered_about(reflect(towards_surface, n), alpha, u);
    bool is_bounded = redraw_below_horizon && !is_mirror;
    mat3 basis = is_bounded ? basis_from_normal(n) : basis_about(n);
    vec3 o = -towards_surface * basis;
    return basis * (is_bounded ? sample_above_horizon(o, alpha, u, pixel)
                               : reflect(-o, sample_visible_normal(o, alpha, u)));
}
#endif
