#ifndef COMMON_GGX_LOBE_H
#define COMMON_GGX_LOBE_H
#include "core/shared/brdf.h"

// Directions of a GGX lobe without its tail. `bias` in [0, 1) is the share that is cut off; the rest is drawn with the
// density of the whole lobe over 1 - bias. Stachowiak and Uludag 2015, "Stochastic Screen-Space Reflections", pull a
// random number towards the peak (0.7); which number that is depends on the mapping. Local frame as in
// core/shared/brdf.h; o: towards the viewer, unit, o.z > 0.

/// The distribution of half vectors.
const uint lobe_of_normals = 0u;
const uint lobe_of_visible_normals = 1u;

/// A normal (unit) with tan^2 = alpha^2 u.x / (1 - u.x) (Walter et al. 2007, eq. 35), restricted to u.x < 1 - bias: the
/// cone about +z with tan = alpha sqrt((1 - bias) / bias). u in [0, 1)^2.
SHARED vec3 sample_truncated_normal(float alpha, float bias, vec2 u) {
    float share = (1.0f - bias) * u.x;
    float tangent = alpha * sqrt(share / (1.0f - share));
    vec2 azimuth = unit_circle(u.y);
    return normalize(vec3(tangent * azimuth.x, tangent * azimuth.y, 1.0f));
}

/// Where the normal +z, which mirrors o, lies on the unit disk of sample_truncated_visible_normal(). v: o stretched.
SHARED vec2 mirror_on_disk(vec3 v) { return vec2(-v.x, -v.y) / (1.0f + v.z); }

/// A visible normal (unit). The area-preserving map takes the unit disk to the spherical cap of Dupuy and Benyoub 2023,
/// "Sampling Visible GGX Normals with Spherical Caps". Shrinking the disk by sqrt(1 - bias) towards the place of +z
/// leaves 1 - bias of its area, with +z inside for every bias and view. Shrunk towards its centre, oblique views would
/// lose their peak. u in [0, 1)^2.
SHARED vec3 sample_truncated_visible_normal(vec3 o, float alpha, float bias, vec2 u) {
    vec3 v = normalize(vec3(alpha * o.x, alpha * o.y, o.z));
    vec2 p = mix(mirror_on_disk(v), sqrt(u.x) * unit_circle(u.y), sqrt(1.0f - bias));
    float n_z = (1.0f + v.z) * (1.0f - dot(p, p));  // of the cap's point + v
    vec2 cap = p * sqrt((1.0f + v.z) * max(0.0f, 1.0f + n_z - v.z));
    // Not 0, where the density would end.
    return normalize(vec3(alpha * (cap.x + v.x), alpha * (cap.y + v.y), max(n_z, 1e-7f)));
}

/// Density (sr^-1) of o mirrored about the normal m of the whole lobe. 0 for normals that face down.
SHARED float density_of_reflection(uint lobe, vec3 o, vec3 m, float alpha) {
    float distribution = ggx_distribution(m, alpha);
    if (lobe == lobe_of_visible_normals) return distribution / (2.0f * (o.z + smith_root(o.z, alpha)));
    return distribution * m.z / (4.0f * max(abs(dot(o, m)), 1e-7f));
}

/// Density (sr^-1) of the unit direction i in the whole lobe. It integrates to 1 over all directions, also those below
/// the horizon.
SHARED float lobe_density(uint lobe, vec3 o, vec3 i, float alpha) {
    vec3 sum = o + i;
    if (dot(sum, sum) < 1e-12f) return 0.0f;  // straight on through the surface
    vec3 m = normalize(sum);
    // A normal that faces away from the viewer mirrors o as its opposite does.
    if (lobe == lobe_of_normals && m.z < 0.0f) m = -m;
    return density_of_reflection(lobe, o, m, alpha);
}

struct LobeSample {
    vec3 direction;         ///< unit; may lie below the horizon
    float inverse_density;  ///< 1 / density of the truncated lobe (sr), above 0
};

/// o mirrored about a normal of the truncated lobe. u in [0, 1)^2.
SHARED LobeSample sample_lobe(uint lobe, vec3 o, float alpha, float bias, vec2 u) {
    vec3 m = lobe == lobe_of_visible_normals ? sample_truncated_visible_normal(o, alpha, bias, u)
                                             : sample_truncated_normal(alpha, bias, u);
    LobeSample drawn;
    drawn.direction = normalize(2.0f * dot(o, m) * m - o);
    drawn.inverse_density = (1.0f - bias) / density_of_reflection(lobe, o, m, alpha);
    return drawn;
}
#endif
