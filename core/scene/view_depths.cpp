#include "core/scene/view_depths.h"

#include "core/scene/deform.h"
#include "core/scene/instance_bounds.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace {

constexpr DepthRange no_depth{std::numeric_limits<double>::infinity(), -1};

DepthRange joined_range(const DepthRange& a, const DepthRange& b) {
    return {std::min(a.nearest, b.nearest), std::max(a.farthest, b.farthest)};
}

/// What a camera's image holds, its clip planes aside.
class Frustum {
public:
    Frustum(const CameraPose& unfitted, glm::uvec2 extent)
        : view_from_world_(glm::inverse(glm::dmat4(unfitted.world_from_view))) {
        const double aspect = double(extent.x) / extent.y;
        const CameraPose pose = fitted(unfitted, aspect);
        const double half =
            pose.is_orthographic ? 0.5 * double(pose.orthographic_height) : std::tan(0.5 * double(pose.vertical_fov));
        const double widening = pose.is_orthographic ? 0 : 1, constant = pose.is_orthographic ? 1 : 0;
        for (const double side : {-1.0, 1.0}) {
            borders_[side < 0 ? 0 : 1] = {side, 0, widening * half * aspect, constant * half * aspect};
            borders_[side < 0 ? 2 : 3] = {0, side, widening * half, constant * half};
        }
        borders_[4] = {0, 0, 1, 0};
    }

    /// x to the right, y up, z the depth.
    glm::dvec3 place(const glm::dmat4& view_from_object, glm::vec3 position) const {
        const glm::dvec4 view = view_from_object * glm::dvec4(position, 1);
        return {view.x, view.y, -view.z};
    }
    const glm::dmat4& view_from_world() const { return view_from_world_; }

    DepthRange depths_of(const std::array<glm::dvec3, 3>& corners) const {
        bool is_inside = true;
        for (const glm::dvec4& border : borders_) {
            int outside = 0;
            for (const glm::dvec3& corner : corners) outside += height(border, corner) < 0;
            if (outside == 3) return no_depth;
            is_inside &= outside == 0;
        }
        if (is_inside) {
            const auto [least, most] = std::minmax({corners[0].z, corners[1].z, corners[2].z});
            return {least, most};
        }
        return depths_of_part(corners);
    }

private:
    /// Above a border; not a distance.
    static double height(const glm::dvec4& border, const glm::dvec3& p) {
        return border.x * p.x + border.y * p.y + border.z * p.z + border.w;
    }

    /// Sutherland and Hodgman 1974, "Reentrant Polygon Clipping". Each border adds a corner, and by rounding half as
    /// many again as there are at most.
    DepthRange depths_of_part(const std::array<glm::dvec3, 3>& corners) const {
        std::array<glm::dvec3, 24> polygon, clipped;
        size_t count = 3;
        std::ranges::copy(corners, polygon.begin());
        for (const glm::dvec4& border : borders_) {
            size_t kept = 0;
            for (size_t i = 0; i < count; ++i) {
                const glm::dvec3 &a = polygon[i], &b = polygon[(i + 1) % count];
                const double above_a = height(border, a), above_b = height(border, b);
                if (above_a >= 0) clipped[kept++] = a;
                if ((above_a >= 0) != (above_b >= 0)) clipped[kept++] = a + (b - a) * (above_a / (above_a - above_b));
            }
            polygon = clipped, count = kept;
            if (count == 0) return no_depth;
        }
        DepthRange range = no_depth;
        for (size_t i = 0; i < count; ++i) range = joined_range(range, {polygon[i].z, polygon[i].z});
        return {std::max(range.nearest, 0.0), std::max(range.farthest, 0.0)};
    }

    glm::dmat4 view_from_world_;
    std::array<glm::dvec4, 5> borders_;
};

}  // namespace

DepthRange depths_in_view(const Scene& scene, const ScenePose& pose, const CameraPose& camera, glm::uvec2 extent) {
    const Frustum frustum(camera, extent);
    DepthRange range = no_depth;
    std::vector<Vertex> deformed;
    for (size_t i = 0; i < scene.instances.size(); ++i) {
        const Mesh& mesh = scene.meshes[scene.instances[i].mesh];
        const std::span<const Vertex> vertices = posed_vertices(scene, pose, i, deformed);
        const glm::dmat4 view_from_object = frustum.view_from_world() * glm::dmat4(pose.world_from_instance[i]);
        const tbb::blocked_range<size_t> all(0, mesh.indices.size() / 3, 4096);
        const auto widen = [&](const tbb::blocked_range<size_t>& triangles, DepthRange found) {
            for (size_t t = triangles.begin(); t < triangles.end(); ++t) {
                const auto corner = [&](size_t k) {
                    return frustum.place(view_from_object, vertices[mesh.indices[3 * t + k]].position);
                };
                found = joined_range(found, frustum.depths_of({corner(0), corner(1), corner(2)}));
            }
            return found;
        };
        range = joined_range(range, tbb::parallel_reduce(all, no_depth, widen, joined_range));
    }
    return range;
}

DepthRange depths_of_boxes(const Scene& scene, const ScenePose& pose, const CameraPose& camera) {
    const InstanceBounds bounds(scene);
    const glm::mat4 view_from_world(glm::inverse(glm::dmat4(camera.world_from_view)));
    DepthRange range = no_depth;
    for (size_t i = 0; i < scene.instances.size(); ++i) {
        const Box box = bounds.at(pose, i).moved(view_from_world);
        if (!(box.low.z <= 0)) continue;  // behind the eye, or empty
        range = joined_range(range, {std::max(-box.high.z, 0.0), -box.low.z});
    }
    return range;
}
