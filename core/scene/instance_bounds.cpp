#include "core/scene/instance_bounds.h"

#include <limits>

namespace {
/// Of float32 transforms of four terms, which the exact box must hold; see rounding_bound() of the path tracer.
constexpr double transform_rounding = 8 * 0x1p-24;

Box with(const Box& box, glm::dvec3 point) { return {glm::min(box.low, point), glm::max(box.high, point)}; }
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
        MeshBoxes boxes{.all = Box::empty(), .of_joints = {}, .of_targets = {}};
        for (const uint32_t index : mesh.indices) {
            const glm::dvec3 position(mesh.vertices[index].position);
            boxes.all = with(boxes.all, position);
            for (unsigned k = 0; k < mesh.joints_per_vertex; ++k) {
                const JointWeight& followed = mesh.joint_weights[size_t(index) * mesh.joints_per_vertex + k];
                if (!(followed.weight > 0.0f)) continue;
                if (followed.joint >= boxes.of_joints.size()) boxes.of_joints.resize(followed.joint + 1, Box::empty());
                boxes.of_joints[followed.joint] = with(boxes.of_joints[followed.joint], position);
            }
        }
        for (const MorphTarget& target : mesh.targets) {
            Box& box = boxes.of_targets.emplace_back(glm::dvec3(0.0), glm::dvec3(0.0));
            for (const glm::vec3 delta : target.positions) box = with(box, glm::dvec3(delta));
        }
        of_mesh_.push_back(std::move(boxes));
    }
}

Box InstanceBounds::at(const ScenePose& pose, size_t instance) const {
    const MeshBoxes& boxes = of_mesh_[scene_.instances[instance].mesh];
    const glm::mat4& world_from_instance = pose.world_from_instance[instance];
    if (pose.deformations.empty()) return boxes.all.moved(world_from_instance);
    const Deformation& deformation = pose.deformations[instance];
    const auto morphed = [&](Box box) {
        for (size_t t = 0; t < deformation.weights.size(); ++t) {
            const glm::dvec3 a = double(deformation.weights[t]) * boxes.of_targets[t].low,
                             b = double(deformation.weights[t]) * boxes.of_targets[t].high;
            box.low += glm::min(a, b), box.high += glm::max(a, b);
        }
        return box;
    };
    if (deformation.instance_from_mesh.empty()) return morphed(boxes.all).moved(world_from_instance);
    // A vertex lies between the places where each of its joints alone would have it.
    Box all = Box::empty();
    for (size_t j = 0; j < boxes.of_joints.size(); ++j) {
        const Box of_joint = morphed(boxes.of_joints[j]).moved(deformation.instance_from_mesh[j]);
        all = {glm::min(all.low, of_joint.low), glm::max(all.high, of_joint.high)};
    }
    return all.moved(world_from_instance);
}
