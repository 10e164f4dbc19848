// The direction of a pixel's ray, drawn from the visible normals of its GGX lobe, and the density of such directions.
#ifndef DILIGENT_SSR_RAY_GLSL
#define DILIGENT_SSR_RAY_GLSL
#include "common/ggx_lobe.h"
#include "common/visible_normal_disk.glsl"
#include "diligent_ssr/distribution.glsl"

const uint half_vectors_disk = 1u, half_vectors_of_all = 2u;  // parameter `half_vectors`

struct SampledRay {
    vec3 direction;  // unit, in the space of the normal
    float density;   // sr^-1, of the whole lobe
};

// Columns: two tangents and the normal. The original's choice of tangents, of which its left-handed view space flips
// both, decides which ray a random number gives.
mat3 basis_about(vec3 n) {
    vec3 tangent = normalize(cross(abs(n.y) > 0.5 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 1.0, 0.0), n));
    return mat3(tangent, cross(n, tangent), n);
}

// Sine of the angle from the pole of a cap of the unit sphere to its rim. Rounding can make the height of a whole
// sphere larger than 2.
float cap_sine(float height) { return sqrt(max(height * (2.0 - height), 0.0)); }

// A visible normal of which the mirror direction is no further than of most: visible normals are, up to the stretch by
// alpha, the sums of v and the directions of a cap about z (Dupuy and Benyoub 2023); v mirrored about z is the one that
// gives z itself. ssrlab's own rule: of that cap a smaller one is kept, of the share 1 - bias of its area, turned from z
// towards the mirrored v as far as it stays within the whole cap. The density of its directions is that of the whole
// lobe over the share.
vec3 sample_normal_near_mirror(vec3 o, float alpha, vec2 u, float bias) {
    vec3 v = normalize(vec3(alpha * o.xy, o.z));
    float height = (1.0 + v.z) * (1.0 - bias);  // of the kept cap
    float cos_kept = 1.0 - height, sin_kept = cap_sine(height);
    float sin_v = length(v.xy);
    // The margin between whole and kept cap: the whole reaches from z as far as -v does.
    float cos_margin = -v.z * cos_kept + sin_v * sin_kept, sin_margin = sin_v * cos_kept + v.z * sin_kept;
    bool reaches_mirror = v.z >= cos_margin;
    float cos_turn = reaches_mirror ? v.z : cos_margin, sin_turn = reaches_mirror ? sin_v : sin_margin;

    vec2 across = sin_v > 0.0 ? -v.xy / sin_v : vec2(1.0, 0.0);
    mat3 cap = mat3(vec3(cos_turn * across, -sin_turn), vec3(-across.y, across.x, 0.0),
                    vec3(sin_turn * across, cos_turn));
    float below_pole = u.y * height;
    vec3 c = cap * vec3(cap_sine(below_pole) * unit_circle(u.x), 1.0 - below_pole);
    vec3 m = vec3(alpha * (c.xy + v.xy), max(c.z + v.z, 0.0));
    // Nothing is visible of a nearly smooth surface that a shading normal turns away from the viewer: 0, as of a mirror.
    float size = length(m);
    return size > 0.0 ? m / size : vec3(0.0, 0.0, 1.0);
}

// Of perfect mirrors the normal itself: what sampling leaves of the horizon's normals is 0 for them, not a direction.
vec3 sample_micro_normal(vec3 o, float alpha, vec2 u) {
    if (alpha == 0.0) return vec3(0.0, 0.0, 1.0);
    float bias = ggx_importance_sample_bias;
    if (half_vectors == half_vectors_of_all) return sample_truncated_normal(alpha, bias, u);
    if (half_vectors == half_vectors_disk) return sample_visible_normal(o, alpha, vec2(u.x * (1.0 - bias), u.y));
    return bias_towards_mirror ? sample_normal_near_mirror(o, alpha, u, bias)
                               : sample_ggx_normal(o, alpha, vec2(u.x, u.y * (1.0 - bias)), 1.0);
}

// Heitz 2018, eq. 17, as the original guards it; `mu_o`, `mu_m`: cosines of viewer and micro-normal.
float reflection_density(float mu_o, float mu_m, float alpha) {
    float masking = 2.0 * max(mu_o, 0.0) / max(mu_o + smith_root(mu_o, alpha), 1e-6);
    return masking * floored_distribution(mu_m, alpha) / (4.0 * mu_o + 5.96e-8);
}

// `towards_surface`, `n`: unit, of one space. `u`: in [0, 1].
SampledRay sample_ray(vec3 towards_surface, vec3 n, float alpha, vec2 u) {
    mat3 basis = basis_about(n);
    vec3 o = -towards_surface * basis;
    vec3 m = sample_micro_normal(o, alpha, u);
    float density = reflection_density(o.z, m.z, alpha);
    if (half_vectors == half_vectors_of_all)
        density = m.z * floored_distribution(m.z, alpha) / (4.0 * max(abs(dot(o, m)), 1e-7));
    return SampledRay(basis * reflect(-o, m), density);
}
#endif
