#pragma once
#include "core/scene/scene.h"

/// The light of an environment as a quadtree over its lat-long texels. Level 0 holds the texels; a node of a higher
/// level holds four nodes of the level below; the last level is a single node. Directions are in world space.
struct EnvironmentTree {
    struct Level {
        glm::uvec2 extent{0, 0};
        std::vector<glm::vec3> flux;         ///< radiance integrated over the node's solid angle
        std::vector<float> solid_angle;      ///< sr
        std::vector<glm::vec3> centre;       ///< unit: mean direction of the solid angle
        std::vector<glm::vec3> flux_centre;  ///< unit: mean direction of the light, so that a lamp is seen where it is
        std::vector<float> radius;           ///< half diagonal (rad)

        size_t index(unsigned x, unsigned y) const { return size_t(y) * extent.x + x; }
    };
    std::vector<Level> levels;
};

/// First averages environments down to a width of at most 1024 texels: a texel is then a quarter of the narrowest lobe
/// that uses the tree. A constant or gradient environment is sampled at 256 x 128 directions.
EnvironmentTree build_environment_tree(const Environment& environment);
