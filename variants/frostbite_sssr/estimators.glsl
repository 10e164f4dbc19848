// The three ways to weigh rays. p: density with which the ray comes about, q: the density of its direction in the
// pixel's own whole lobe; f: the pixel's BRDF times cosine, per colour channel.
//   a: sum L f / p over sum f / p: Stachowiak and Uludag 2015.
//   b: sum L f / p over sum q / p, times 1 / reflectance: Stachowiak's kajiya. The second sum estimates the part of
//      the lobe that rays are drawn from, and includes what of it lies below the horizon: as it is drawn, or, where rays
//      are drawn again in its place, as the share that it is known to have.
//   c: sum L q / p over sum q / p: Blender's EEVEE.
#ifndef FROSTBITE_SSSR_ESTIMATORS_GLSL
#define FROSTBITE_SSSR_ESTIMATORS_GLSL
#include "common/luminance.glsl"
#include "frostbite_sssr/horizon.glsl"
#include "frostbite_sssr/ray_radiance.glsl"

const bool is_estimator_b = estimator == 1u, is_estimator_c = estimator == 2u;

struct Sums {
    vec3 weighed_radiance, weight, known_weight;  // known: times confidence
    float density_ratio;                          // of b: sum of q / p
    float ray_length, ray_length_weight;          // of `average`
    float shortest, longest;                      // 0: none
};

const Sums no_sums = Sums(vec3(0.0), vec3(0.0), vec3(0.0), 0.0, 0.0, 0.0, 0.0, 0.0);


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

// What one ray adds to b's second sum. `density_ratio`: q / p.
float lobe_share(Surface surface, float mu_i, bool is_traced, float density_ratio) {
    if (max_regenerations == 0u) return is_traced || mu_i <= 0.0 ? density_ratio : 0.0;
    float below = (1.0 - importance_bias) * share_below_horizon(surface.o.z, surface.roughness);
    return below + (is_traced && mu_i > 0.0 ? density_ratio : 0.0);
}

void add_ray(inout Sums sums, ivec2 pixel, Surface surface, ReusedRay ray) {
    OwnRay own = as_own_ray(surface, ray);
    // As in the path-traced reference such a direction is known to bring no light, whatever a neighbour's ray met along it.
    // One into the neighbour's surface alone was never looked along.
    bool is_into_surface = dot(own.direction, surface.geometric_normal) <= 0.0;
    if (ray.traced.target == ray_into_surface && !is_into_surface) return;
    vec3 i = own.direction * surface.view_from_local;
    float density_ratio = lobe_density(lobe, surface.o, i, surface.alpha) * own.inverse_density;
    bool is_traced = ray.traced.target != ray_below_horizon;
    if (is_estimator_b) sums.density_ratio += lobe_share(surface, i.z, is_traced, density_ratio);
    if (!is_traced || i.z <= 0.0) return;

    vec3 weight = is_estimator_c ? vec3(density_ratio) : reflectance_density(surface, i) * own.inverse_density;
    Seen seen = is_into_surface ? Seen(vec3(0.0), 1.0) : seen_along(pixel, surface, ray, own);
    sums.weight += weight;
    sums.known_weight += seen.confidence * weight;
    sums.weighed_radiance += seen.confidence * weight * seen.radiance;
    if (is_into_surface) return;
    add_ray_length(sums, own.ray_length, ray.traced.confidence * luminance_bt709(weight), density_ratio);
}

vec3 ratio_or_zero(vec3 a, vec3 b) { return mix(vec3(0.0), a / max(b, vec3(1e-37)), greaterThan(b, vec3(0.0))); }

// rgb: radiance before the BRDF, or times its integral without reflectance_after_filter; w: confidence.
vec4 resolved(Sums sums, Surface surface) {
    float weight = luminance_bt709(sums.weight);
    float confidence = weight > 0.0 ? luminance_bt709(sums.known_weight) / weight : 0.0;
    if (confidence > 1.0) confidence = 1.0;  // GPUs that fuse products with sums round the two sums differently
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
