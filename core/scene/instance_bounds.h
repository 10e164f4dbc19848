#pragma once
#include "core/scene/scene.h"

/// An axis-aligned box (m); `low` is above `high` if it holds nothing.
struct Box {
    glm::dvec3 low, high;

    static Box empty();

    double nearest_to(glm::dvec3 point) const;     ///< distance (m); 0 inside
    double farthest_from(glm::dvec3 point) const;  ///< distance (m) of the farthest corner
    Box moved(const glm::mat4& transform) const;   ///< a box around the transformed one, with room for rounding
};

/// Boxes around what a scene's instances draw at a frame. Each takes a few operations, as boxes of meshes are made
/// once.
class InstanceBounds {
public:
    /// `scene` must outlive this.
    explicit InstanceBounds(const Scene& scene);

    /// A box in world space that holds all vertices of the instance, and may be larger than needed. Only this function
    /// knows how vertices get to their places.
    Box at(const ScenePose& pose, size_t instance) const;

private:
    /// Object space.
    struct MeshBoxes {
        Box all;
        std::vector<Box> of_joints;   ///< about the vertices that follow each joint
        std::vector<Box> of_targets;  ///< about what each morph target adds to positions
    };
    const Scene& scene_;
    std::vector<MeshBoxes> of_mesh_;
};
