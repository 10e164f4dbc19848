#include "core/scene/instance_bounds.h"

#include <limits>

namespace {
/// Of float32 transforms of four terms, which the exact box must hold; see rounding_bound() of the path tracer.
constexpr double transform_rounding = 8 * 0x1p-24;
}  // namespace

Box Box::empty() {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    return {glm::dvec3(infinity), glm::dvec3(-infinity)};
}

double Box::nearest_to(glm::dvec3 point) const {
    return glm::length(glm::max(glm::max(low - point, point - high), glm::dvec3(0.0)));
}

double Box::farthest_from(glm::dvec3 point) const {
    return glm::length(glm::max(glm::abs(low - point), glm::abs(high - point)));
}

Box Box::moved(const glm::mat4& transform) const {
    if (low.x > high.x) return *this;
    const glm::dmat3 linear(transform);
    const glm::dmat3 size(glm::abs(linear[0]), glm::abs(linear[1]), glm::abs(linear[2]));
    const glm::dvec3 translation(transform[3]), centre = 0.5 * (low + high), half = 0.5 * (high - low);
    const glm::dvec3 moved = linear * centre + translation;
    const glm::dvec3 rounding =
        transform_rounding * (size * glm::max(glm::abs(low), glm::abs(high)) + glm::abs(translation));
    const glm::dvec3 reach = size * half + rounding;
    return {moved - reach, moved + reach};
}

InstanceBounds::InstanceBounds(const Scene& scene) : scene_(scene) {
    for (const Mesh& mesh : scene.meshes) {
        Box box = Box::empty();
        for (const uint32_t index : mesh.indices) {
            const glm::dvec3 position(mesh.vertices[index].position);
            box = {glm::min(box.low, position), glm::max(box.high, position)};
        }
        of_mesh_.push_back(box);
    }
}

Box InstanceBounds::at(const ScenePose& pose, size_t instance) const {
    return of_mesh_[scene_.instances[instance].mesh].moved(pose.world_from_instance[instance]);
}
