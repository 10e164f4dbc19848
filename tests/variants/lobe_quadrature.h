#pragma once
#include "variants/common/ggx_lobe.h"

#include <string>

// Truncated lobes written down once more, in double precision, and integrals over them by brute force.

struct LobeCase {
    unsigned lobe;
    float roughness, view_degrees, bias;

    float alpha() const { return ggx_alpha(roughness); }
    glm::vec3 o() const { return {std::sin(glm::radians(view_degrees)), 0, std::cos(glm::radians(view_degrees))}; }
};
std::string name_of(const LobeCase& c);

/// Whether the normal m is left by truncation: within the cone of that share of the distribution, or within the disk of
/// that share about the mirror's place.
bool is_left_by_truncation(const LobeCase& c, glm::dvec3 m);

/// Density of normals (sr^-1): Walter et al. 2007, eq. 33; Heitz 2018, eq. 1, with Smith's masking.
double lobe_normal_density(const LobeCase& c, glm::dvec3 m);

/// m from the share of all normals nearer to the pole, and its azimuth; with solid angle per share and turn.
glm::dvec3 lobe_normal(const LobeCase& c, double share, double azimuth, double& solid_angle);

/// The mean over the truncated lobe's draws of g(direction of reflection, unit, local). Where g or the lobe is cut off
/// within a cell, of which there are 240 x 240, its error is up to 3e-3 of g's range.
template <class Function>
double mean_over_lobe(const LobeCase& c, const Function& g) {
    const int steps = 240;
    const glm::dvec3 o = c.o();
    double sum = 0;
    for (int i = 0; i < steps; ++i)
        for (int k = 0; k < steps; ++k) {
            const double rest = 1 - (i + 0.5) / steps;
            // Of the whole lobe visible normals grow as 1 / sqrt(1 - share) towards the horizon, beside all normals.
            const bool is_whole = c.bias == 0;
            const double share = 1 - (is_whole ? rest * rest : rest), rate = is_whole ? 2 * rest : 1;
            double solid_angle;
            const glm::dvec3 m = lobe_normal(c, share, 2 * M_PI * (k + 0.5) / steps, solid_angle);
            const double weight = lobe_normal_density(c, m) * solid_angle * rate;
            if (weight > 0) sum += weight * g(2 * glm::dot(o, m) * m - o);
        }
    return sum / (double(steps) * steps);
}
