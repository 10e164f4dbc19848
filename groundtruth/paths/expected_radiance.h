#pragma once
#include "groundtruth/sampling/learning_grid.h"

#include <span>
#include <vector>

/// What one path found beyond one of its vertices.
struct RadianceObservation {
    vec3 position;   ///< of the vertex (m)
    vec3 normal;     ///< geometric, on the side that was met
    float radiance;  ///< luminance that the path still brought, over the luminance of its throughput beyond the vertex
};

/// The radiance that a path is to expect where it goes on, by cells: with it Russian roulette ends paths that promise
/// little to their pixel, keeps dark ones on their way to bright places, and splits those that promise much (Vorba and
/// Krivanek 2016, "Adjoint-Driven Russian Roulette and Splitting in Light Transport Simulation"). It is learnt from
/// paths that a render does not use, and decides with which probability a path goes on, or into how many parts, which
/// its weight makes up for: no mean depends on it.
class ExpectedRadiance {
public:
    /// `low`, `high`: bounds of the scene (m). The same observations in the same order give the same bits.
    void learn(std::span<const RadianceObservation> observations, vec3 low, vec3 high);

    /// 0 everywhere until something is learnt.
    float at(vec3 position, vec3 normal) const;

private:
    LearningGrid grid_;
    std::vector<float> radiance_;  ///< of grid_; empty: nothing is learnt
};
