#pragma once
#include "variants/common/ggx_lobe.h"

#include <random>
#include <vector>

// One bright disk over a dark environment, seen by a flat reflector: what Frostbite's estimators are compared on.

/// A cap of 12 degrees half angle, 32 degrees from the normal in the plane of view and mirror direction: there the
/// fact sheet's signs and sizes are found.
struct EmitterCase {
    float roughness, view_degrees;
    float emitter_degrees = 12, emitter_from_normal = 32, emitter_radiance = 10, other_radiance = 0.2f;

    float alpha() const { return ggx_alpha(roughness); }
    glm::vec3 o() const;                     ///< towards the viewer, local
    bool is_emitter(glm::vec3 local) const;  ///< whether that direction meets it
    float radiance(glm::vec3 local) const { return is_emitter(local) ? emitter_radiance : other_radiance; }
};

/// A direction of the upper hemisphere with its share of an integral over the sphere.
struct LobePoint {
    double density;    ///< of the truncated lobe (sr^-1)
    double reflected;  ///< BRDF times cosine, without Fresnel
    double radiance;
    double solid_angle;
};

/// What quadrature says of a case and a lobe: of the directions that truncation leaves, which without it are all.
struct EmitterTruth {
    std::vector<LobePoint> points;
    double reflectance = 0;    ///< integral of the BRDF
    double reflected = 0;      ///< of radiance times BRDF
    double below_horizon = 0;  ///< share of the truncated lobe's draws

    double mean() const { return reflected / reflectance; }
};
/// `importance_bias`: the share of the lobe that truncation takes.
EmitterTruth emitter_truth(const EmitterCase& scene, unsigned lobe, float importance_bias = 0);

/// Expectations of the estimators over `rays` independent rays of the pixel itself, each drawn again until it is above
/// the horizon, relative to what they estimate. 1 / sum = integral of exp(-t sum) over t turns the mean of a ratio of
/// sums into an integral of products.
double bias_of_a(const EmitterTruth& truth, unsigned rays);
double bias_of_c(const EmitterTruth& truth);
/// With this many `regenerations` at most: each ray counts its q / p and the share of the lobe that is below the
/// horizon. What b estimates is `reflected` over the share of the lobe that truncation leaves.
double bias_of_b(const EmitterTruth& truth, unsigned rays, unsigned regenerations);

/// Density of the lobe over that with which a ray above the horizon comes about.
double redrawn_factor(const EmitterTruth& truth, unsigned regenerations);

/// Rays drawn as a tracer does.
struct DrawnRay {
    glm::vec3 direction{0};     ///< local
    float inverse_density = 0;  ///< of the lobe
    bool is_below_horizon = false;
};
DrawnRay draw_ray(const EmitterCase& scene, unsigned lobe, float bias, unsigned regenerations, std::mt19937& random);
