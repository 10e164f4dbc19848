#pragma once
#include "core/scene/scene.h"

/// An axis-aligned box (m); `low` is above `high` if it holds nothing.
struct Box {
    glm::dvec3 low, high;

    static Box empty();

    double nearest_to(glm::dvec3 point) const;     ///< distance (m); 0 inside
    double farthest_from(glm::dvec3 point) const;  ///< distance (m) of the farthest corner
    Box moved(const glm::mat4& transform) const;   ///< a box about the transformed one, rounding allowed for
};

/// Boxes about what a scene's instances draw at a frame, for a few operations each: the boxes of meshes are made once.
class InstanceBounds {
public:
    /// `scene` must outlive this.
    explicit InstanceBounds(const Scene& scene);

    /// World space. The one place that knows how an instance's vertices get to their places. Holds all of them, and may
    /// be larger than need be.
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
