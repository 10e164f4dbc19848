#pragma once
#include "core/scene/scene.h"
#include "tests/variants/frostbite_bench.h"

/// Frostbite's resolve written down once more, in double precision and with every sum in the open: without
/// filtered_sampling, of pixels whose taps the caller names; estimator b for max_regenerations = 0 only.
class FrostbiteReference {
public:
    /// Reads the bench's G-buffer and parameters as they are now. `environment`: of misses.
    FrostbiteReference(FrostbiteBench& bench, const std::vector<StoredRay>& rays, const Environment& environment);

    struct Result {
        glm::dvec3 radiance{0};
        double confidence = 0, length = 0;
        bool is_close_call = false;  ///< a comparison that float32 may decide otherwise
    };
    /// `color`: of the lit image at a place of the screen in pixels. `taps`: traced pixels, distinct.
    Result resolve(glm::uvec2 pixel, const std::vector<glm::uvec2>& taps,
                   const std::function<glm::dvec3(glm::dvec2)>& color) const;

private:
    struct Surface {
        glm::dvec3 position, n, geometric_n, o;
        double alpha, mu_o;
        glm::dvec3 f0;
        double f90;
    };
    struct Weighed {
        glm::dvec3 weight, radiance;
        double confidence, length, density_ratio;
    };

    Surface surface(glm::uvec2 pixel) const;
    glm::dvec3 reflectance_density(const Surface& s, glm::dvec3 l) const;
    double lobe_density(const Surface& s, glm::dvec3 l) const;
    double inverse_density(const StoredRay& ray, glm::dvec3 l, double length) const;
    glm::dvec2 color_place(glm::uvec2 pixel) const;

    FrostbiteBench& bench_;
    const std::vector<StoredRay>& rays_;
    const Environment& environment_;
    glm::dmat4 view_from_clip_;
    glm::dmat3 view_from_world_;
    HostImage depth_, normal_, geometric_normal_, base_color_, emission_, dielectric_f0_, motion_;
};
