#ifndef SHARED_BRDF_H
#define SHARED_BRDF_H
#include "core/shared/language.h"

// The glTF 2.0 metallic-roughness BRDF (Specification, Appendix B) in a local frame with the shading normal along +z:
//   f = (1 - metalness) [(1 - Fd) c / pi + Fd D V] + metalness Fm D V
// `alpha` is the GGX width, the square of the perceptual roughness that files and the G-buffer hold.
// o: towards the viewer, i: towards the light, both unit; mu_x: cosine of x to the normal.

const float pi = 3.14159265358979f;

/// Both renderers treat smaller widths as this one; see ggx_alpha().
const float min_ggx_alpha = 1e-3f;

SHARED float ggx_alpha(float perceptual_roughness) {
    return max(perceptual_roughness * perceptual_roughness, min_ggx_alpha);
}

/// GGX distribution of normals (Walter et al. 2007, eq. 33) for a unit micro-normal m. sin^2 is taken from m.xy: 1 -
/// m.z^2 loses up to 35 % of D in float at alpha = 1e-3.
SHARED float ggx_distribution(vec3 m, float alpha) {
    float a2 = alpha * alpha;
    float t = m.x * m.x + m.y * m.y + a2 * m.z * m.z;
    return m.z > 0.0f ? a2 / (pi * t * t) : 0.0f;
}

/// sqrt(alpha^2 + (1 - alpha^2) mu^2), of which the Smith terms below are made.
SHARED float smith_root(float mu, float alpha) {
    float a2 = alpha * alpha;
    return sqrt(a2 + (1.0f - a2) * mu * mu);
}

/// Height-correlated Smith masking and shadowing over 4 mu_o mu_i (glTF 2.0, Appendix B.3.2; Heitz 2014, eq. 99).
SHARED float smith_visibility(float mu_o, float mu_i, float alpha) {
    return 0.5f / (mu_o * smith_root(mu_i, alpha) + mu_i * smith_root(mu_o, alpha));
}

/// (1 - cos)^5 of Schlick's approximation.
SHARED float schlick_weight(float cosine) {
    float x = clamp(1.0f - cosine, 0.0f, 1.0f);
    float x2 = x * x;
    return x2 * x2 * x;
}

/// Reflectance at normal incidence of a dielectric with glTF's default index of refraction, 1.5.
const float usual_dielectric_f0 = 0.04f;

/// Reflectance at normal incidence of the mix of dielectric and metal. `specular`: the factor of
/// KHR_materials_specular, which scales the dielectric's own, `dielectric_f0`.
SHARED vec3 specular_f0(vec3 base_color, float metalness, float specular, vec3 dielectric_f0) {
    return mix(dielectric_f0 * specular, base_color, metalness);
}
/// The same for an index of refraction of 1.5.
SHARED vec3 specular_f0(vec3 base_color, float metalness, float specular) {
    return mix(vec3(0.04f * specular), base_color, metalness);
}

/// Reflectance at grazing incidence, the same for all colours and indices of refraction.
SHARED float specular_f90(float metalness, float specular) { return mix(specular, 1.0f, metalness); }

/// The factor by which an engine's pass adds reflected radiance to an image (its documentation of 2026-01-14,
/// "Composite Pass"). It is Schlick's Fresnel term at the surface's normal (mu_o: cosine of the viewer) times the
/// weight, and up to half less on metals. The dielectric reflectance is always 0.04.
SHARED vec3 additive_weight(vec3 base_color, float metalness, float mu_o, float weight) {
    vec3 f0 = mix(vec3(0.04f), base_color, metalness);
    vec3 fresnel = f0 + (vec3(1.0f) - f0) * schlick_weight(mu_o);
    return fresnel * (weight * (1.0f - 0.5f * metalness * weight));
}

/// D V of the specular lobe, 0 unless both directions are above the horizon.
SHARED float ggx_specular(vec3 o, vec3 i, float alpha) {
    if (o.z <= 0.0f || i.z <= 0.0f) return 0.0f;
    return ggx_distribution(normalize(o + i), alpha) * smith_visibility(o.z, i.z, alpha);
}

/// The weight f mu_i / pdf of a sample, without Fresnel: at most 1, and 0 below the horizon.
SHARED float ggx_reflection_weight(float mu_o, float mu_i, float alpha) {
    if (mu_i <= 0.0f) return 0.0f;
    float root_o = smith_root(mu_o, alpha);
    return mu_i * (mu_o + root_o) / (mu_o * smith_root(mu_i, alpha) + mu_i * root_o);
}

/// The share of o's z component that bounds the sampled cap: Eto and Tokuyoshi 2023, "Bounded VNDF Sampling for
/// Smith-GGX Reflections", isotropic. Fewer samples end below the horizon, those above keep their relative density.
SHARED float ggx_cap_bound(float mu_o, float alpha) {
    float s = 1.0f + sqrt(max(0.0f, 1.0f - mu_o * mu_o));
    float s2 = s * s;
    float a2 = alpha * alpha;
    return (1.0f - a2) * s2 / (s2 + a2 * mu_o * mu_o);
}

/// (cos, sin) of 2 pi `turns`, for turns in [0, 1], to 1e-7: Taylor series within an eighth of a turn.
SHARED vec2 unit_circle(float turns) {
    int quarter = int(4.0f * turns + 0.5f);
    float x = 2.0f * pi * (turns - 0.25f * float(quarter));
    float x2 = x * x;
    float s = x * (1.0f + x2 * (-1.0f / 6.0f + x2 * (1.0f / 120.0f + x2 * (-1.0f / 5040.0f + x2 / 362880.0f))));
    float c = 1.0f + x2 * (-0.5f + x2 * (1.0f / 24.0f + x2 * (-1.0f / 720.0f + x2 / 40320.0f)));
    bool is_odd = (quarter & 1) != 0;
    float a = is_odd ? s : c;
    float b = is_odd ? c : s;
    bool flips_cosine = quarter == 1 || quarter == 2;
    bool flips_sine = quarter == 2 || quarter == 3;
    return vec2(flips_cosine ? -a : a, flips_sine ? -b : b);
}

/// A visible micro-normal (unit) for o.z > 0 and u in [0, 1)^2: Dupuy and Benyoub 2023, "Sampling Visible GGX Normals
/// with Spherical Caps". `bound` is 1 for the whole lobe or ggx_cap_bound() for the part that can reflect above the
/// horizon.
SHARED vec3 sample_ggx_normal(vec3 o, float alpha, vec2 u, float bound) {
    vec3 v = normalize(vec3(alpha * o.x, alpha * o.y, o.z));
    float b = bound * v.z;
    float z = (1.0f - u.y) * (1.0f + b) - b;
    float r = sqrt(clamp(1.0f - z * z, 0.0f, 1.0f));
    vec2 azimuth = unit_circle(u.x);
    vec3 n = vec3(r * azimuth.x, r * azimuth.y, z) + v;
    return normalize(vec3(alpha * n.x, alpha * n.y, max(n.z, 0.0f)));
}

/// o mirrored about a visible normal of the bounded cap; may lie below the horizon.
SHARED vec3 sample_ggx_reflection_bounded(vec3 o, float alpha, vec2 u) {
    vec3 m = sample_ggx_normal(o, alpha, u, ggx_cap_bound(o.z, alpha));
    return 2.0f * dot(o, m) * m - o;
}

/// A unit vector over the hemisphere of +z with density mu / pi (Malley's method), for u in [0, 1)^2.
SHARED vec3 sample_cosine(vec2 u) {
    float r = sqrt(u.x);
    vec2 azimuth = unit_circle(u.y);
    return vec3(r * azimuth.x, r * azimuth.y, sqrt(max(0.0f, 1.0f - u.x)));
}

/// Columns tangent, bitangent, normal of a right-handed frame: Duff et al. 2017, "Building an Orthonormal Basis,
/// Revisited".
SHARED mat3 basis_from_normal(vec3 n) {
    float s = n.z >= 0.0f ? 1.0f : -1.0f;
    float a = -1.0f / (s + n.z);
    float b = n.x * n.y * a;
    return mat3(vec3(1.0f + s * n.x * n.x * a, s * b, -s * n.x), vec3(b, s + n.y * n.y * a, -n.y), n);
}
#endif
