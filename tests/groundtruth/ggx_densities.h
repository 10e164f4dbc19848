#pragma once
#include "core/shared/brdf.h"

// The whole lobe, and the densities of its sampler and of that of brdf.h: what tests judge samplers by.

/// o mirrored about a visible normal of the whole lobe; may lie below the horizon.
inline vec3 sample_ggx_reflection(vec3 o, float alpha, vec2 u) {
    vec3 m = sample_ggx_normal(o, alpha, u, 1.0f);
    return 2.0f * dot(o, m) * m - o;
}

/// Density (sr^-1) over directions i of sample_ggx_reflection(): Heitz 2018, eq. 17, rearranged so that nothing
/// is divided by mu_o. Directions below the horizon have a density too: such samples count as zero.
inline float ggx_reflection_pdf(vec3 o, vec3 i, float alpha) {
    return ggx_distribution(normalize(o + i), alpha) / (2.0f * (o.z + smith_root(o.z, alpha)));
}

/// Density (sr^-1) of sample_ggx_reflection_bounded().
inline float ggx_reflection_bounded_pdf(vec3 o, vec3 i, float alpha) {
    return ggx_distribution(normalize(o + i), alpha) /
           (2.0f * (ggx_cap_bound(o.z, alpha) * o.z + smith_root(o.z, alpha)));
}
