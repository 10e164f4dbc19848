#pragma once
#include "core/scene/scene.h"

/// The light of an environment, as a quadtree over its lat-long texels: level 0 holds the texels, each level above four
/// of the one below per node, the last a single node. Structure of arrays per level; all directions are in world space.
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

/// Environments wider than 1024 texels are averaged down to at most that first: a quarter of the narrowest lobe for
/// which the tree is used. A constant or gradient environment is sampled at 256 x 128 directions.
EnvironmentTree build_environment_tree(const Environment& environment);
