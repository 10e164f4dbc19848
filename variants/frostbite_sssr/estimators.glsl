// The three ways to weigh rays. p: density of the ray, q: the pixel's own density of its direction, both of whole lobes
// but for the factor 1 / (1 - importance_bias) of p; f: the pixel's BRDF times cosine, per colour channel.
//   a: sum L f / p over sum f / p: Stachowiak and Uludag 2015.
//   b: sum L f / p over sum q / p, times 1 / reflectance: Stachowiak's kajiya. Draws below the horizon count in the
//      second sum, which else were too small by their share.
//   c: sum L q / p over sum q / p: Blender's EEVEE.
#ifndef FROSTBITE_SSSR_ESTIMATORS_GLSL
#define FROSTBITE_SSSR_ESTIMATORS_GLSL
#include "frostbite_sssr/ray_radiance.glsl"

const bool is_estimator_b = estimator == 1u, is_estimator_c = estimator == 2u;

struct Sums {
    vec3 weighed_radiance, weight, known_weight;  // known: times confidence
    float density_ratio;                          // of b: sum of q / p
    float ray_length, ray_length_weight;          // of `average`
    float shortest, longest;                      // 0: none
};

const Sums no_sums = Sums(vec3(0.0), vec3(0.0), vec3(0.0), 0.0, 0.0, 0.0, 0.0, 0.0);

float luminance(vec3 color) { return dot(color, vec3(0.2126, 0.7152, 0.0722)); }  // ITU-R BT.709

void add_ray_length(inout Sums sums, float ray_length, float weight, float density_ratio) {
    // Those that the pixel itself would hardly have drawn must not decide alone (Wicked Engine's threshold).
    const float least_density_ratio = 1e-3;
    if (ray_length == 0.0 || weight == 0.0) return;
    sums.ray_length += weight * ray_length;
    sums.ray_length_weight += weight;
    if (density_ratio < least_density_ratio) return;
    sums.shortest = sums.shortest == 0.0 ? ray_length : min(sums.shortest, ray_length);
    sums.longest = max(sums.longest, ray_length);
}

void add_ray(inout Sums sums, ivec2 pixel, Surface surface, ReusedRay ray) {
    OwnRay own = as_own_ray(surface, ray);
    vec3 i = own.direction * surface.view_from_local;
    float density_ratio = lobe_density(lobe, surface.o, i, surface.alpha) * own.inverse_density;
    bool is_traced = ray.traced.target != ray_below_horizon;
    // A draw that was thrown away is one of the pixel's own, as far as is known of it: q / p = 1 - importance_bias.
    sums.density_ratio += float(ray.traced.discarded_draws) * (1.0 - importance_bias);
    if (is_traced || i.z <= 0.0) sums.density_ratio += density_ratio;
    if (!is_traced || i.z <= 0.0) return;

    vec3 weight = is_estimator_c ? vec3(density_ratio) : reflectance_density(surface, i) * own.inverse_density;
    Seen seen = seen_along(pixel, surface, ray, own);
    sums.weight += weight;
    sums.known_weight += seen.confidence * weight;
    sums.weighed_radiance += seen.confidence * weight * seen.radiance;
    add_ray_length(sums, own.ray_length, ray.traced.confidence * luminance(weight), density_ratio);
}

vec3 ratio_or_zero(vec3 a, vec3 b) { return mix(vec3(0.0), a / max(b, vec3(1e-37)), greaterThan(b, vec3(0.0))); }

// rgb: radiance before the BRDF, or times its integral without reflectance_after_filter; w: confidence.
vec4 resolved(Sums sums, Surface surface) {
    float weight = luminance(sums.weight);
    float confidence = weight > 0.0 ? luminance(sums.known_weight) / weight : 0.0;
    if (!is_estimator_b) {
        vec3 radiance = ratio_or_zero(sums.weighed_radiance, sums.known_weight);
        return vec4(reflectance_after_filter ? radiance : radiance * reflectance(surface), confidence);
    }
    if (sums.density_ratio == 0.0) return vec4(0.0);
    if (weight == 0.0) return vec4(0.0, 0.0, 0.0, 1.0);  // all went below the horizon, which reflects nothing
    // What is composited is radiance times confidence.
    vec3 reflected = ratio_or_zero(sums.weighed_radiance, vec3(sums.density_ratio * confidence));
    return vec4(reflectance_after_filter ? ratio_or_zero(reflected, reflectance(surface)) : reflected, confidence);
}

float length_of(Sums sums) {
    if (reflection_depth == 1u) return sums.shortest;
    if (reflection_depth == 2u) return sums.longest;
    return sums.ray_length_weight > 0.0 ? sums.ray_length / sums.ray_length_weight : 0.0;
}
#endif
