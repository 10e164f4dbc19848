#pragma once
#include "groundtruth/sampling/learning_grid.h"
#include "groundtruth/sampling/prefetch.h"

#include <span>
#include <vector>

/// What one path found beyond one of its vertices.
struct RadianceObservation {
    vec3 position;   ///< of the vertex (m)
    vec3 normal;     ///< geometric, on the side that was met
    float radiance;  ///< luminance that the path brought beyond the vertex, over the luminance of its throughput there
};

/// The radiance that a path can expect where it goes on, by cells. Russian roulette ends paths that promise little to
/// their pixel, keeps dark paths that lead to bright places, and splits paths that promise much (Vorba and Krivanek
/// 2016, "Adjoint-Driven Russian Roulette and Splitting in Light Transport Simulation"). It is learnt from paths that a
/// render does not use. It decides the probability that a path goes on, or the number of parts; weights compensate for
/// both, so no mean depends on it.
class ExpectedRadiance {
public:
    /// The same observations in the same order give the same bits.
    void learn(std::span<const RadianceObservation> observations, const LearningGrid& grid);

    bool is_learnt() const { return !radiance_.empty(); }
    /// The expected radiance at an index of the grid; 0 everywhere until something is learnt.
    float at(size_t index) const { return radiance_.empty() ? 0.0f : radiance_[index]; }
    /// Prefetches what at() will read.
    void prefetch(size_t index) const {
        if (!radiance_.empty()) prefetch_line(&radiance_[index]);
    }

private:
    std::vector<float> radiance_;  ///< of the grid; empty: nothing is learnt
};
