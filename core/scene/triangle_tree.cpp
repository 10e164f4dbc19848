#include "core/scene/triangle_tree.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>
#include <algorithm>
#include <limits>
#include <numeric>

namespace {
/// Ericson, "Real-Time Collision Detection" (2005), section 5.1.5.
glm::dvec3 closest_point(glm::dvec3 p, glm::dvec3 a, glm::dvec3 b, glm::dvec3 c) {
    const glm::dvec3 ab = b - a, ac = c - a, bc = c - b;
    const double d1 = glm::dot(ab, p - a), d2 = glm::dot(ac, p - a);
    if (d1 <= 0 && d2 <= 0) return a;
    const double d3 = glm::dot(ab, p - b), d4 = glm::dot(ac, p - b);
    if (d3 >= 0 && d4 <= d3) return b;
    const double d5 = glm::dot(ab, p - c), d6 = glm::dot(ac, p - c);
    if (d6 >= 0 && d5 <= d6) return c;
    const double area_c = d1 * d4 - d3 * d2, area_b = d5 * d2 - d1 * d6, area_a = d3 * d6 - d5 * d4;
    if (area_c <= 0 && d1 >= 0 && d3 <= 0) return a + ab * (d1 / (d1 - d3));
    if (area_b <= 0 && d2 >= 0 && d6 <= 0) return a + ac * (d2 / (d2 - d6));
    if (area_a <= 0 && d4 >= d3 && d5 >= d6) return b + bc * ((d4 - d3) / ((d4 - d3) + (d5 - d6)));
    const double area = area_a + area_b + area_c;
    return area > 0 ? a + (ab * area_b + ac * area_c) / area : a;
}

double distance_of(const std::vector<uint32_t>& indices, std::span<const Vertex> vertices, size_t triangle,
                   const glm::mat4& world_from_mesh, glm::vec3 point) {
    const auto corner = [&](size_t k) {
        return glm::dvec3(world_from_mesh * glm::vec4(vertices[indices[triangle * 3 + k]].position, 1.0f));
    };
    return glm::distance(glm::dvec3(point), closest_point(point, corner(0), corner(1), corner(2)));
}

constexpr uint32_t triangles_of_leaf = 8;
}  // namespace

double nearest_distance(const std::vector<uint32_t>& indices, std::span<const Vertex> vertices,
                        const glm::mat4& world_from_mesh, glm::vec3 point) {
    const auto nearer = [&](const tbb::blocked_range<size_t>& triangles, double nearest) {
        for (size_t i = triangles.begin(); i < triangles.end(); ++i)
            nearest = std::min(nearest, distance_of(indices, vertices, i, world_from_mesh, point));
        return nearest;
    };
    const tbb::blocked_range<size_t> all(0, indices.size() / 3, 4096);
    return tbb::parallel_reduce(all, std::numeric_limits<double>::infinity(), nearer,
                                [](double a, double b) { return std::min(a, b); });
}

TriangleTree::TriangleTree(const Mesh& mesh) : mesh_(mesh), triangles_(mesh.indices.size() / 3) {
    std::iota(triangles_.begin(), triangles_.end(), 0u);
    if (triangles_.empty()) return;
    std::vector<Box> boxes;
    for (const uint32_t triangle : triangles_) {
        const auto corner = [&](size_t k) {
            return glm::dvec3(mesh.vertices[mesh.indices[triangle * 3 + k]].position);
        };
        boxes.push_back(
            {glm::min(corner(0), glm::min(corner(1), corner(2))), glm::max(corner(0), glm::max(corner(1), corner(2)))});
    }
    build(0, uint32_t(triangles_.size()), boxes);
}

/// Halves along the longest side of the box about the triangles' middles, so that its depth is the logarithm of their
/// number.
uint32_t TriangleTree::build(uint32_t first, uint32_t count, const std::vector<Box>& boxes) {
    const auto node = uint32_t(nodes_.size());
    nodes_.push_back({Box::empty(), first, count});
    Box middles = nodes_.back().box;
    for (uint32_t i = first; i < first + count; ++i) {
        const Box& box = boxes[triangles_[i]];
        Box& all = nodes_.back().box;
        all = {glm::min(all.low, box.low), glm::max(all.high, box.high)};
        const glm::dvec3 middle = 0.5 * (box.low + box.high);
        middles = {glm::min(middles.low, middle), glm::max(middles.high, middle)};
    }
    const glm::dvec3 size = middles.high - middles.low;
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    if (count <= triangles_of_leaf) return node;
    const uint32_t half = count / 2;
    const auto start = triangles_.begin() + first;
    std::nth_element(start, start + half, start + count, [&](uint32_t a, uint32_t b) {
        const double of_a = boxes[a].low[axis] + boxes[a].high[axis], of_b = boxes[b].low[axis] + boxes[b].high[axis];
        return of_a < of_b;
    });
    build(first, half, boxes);
    const uint32_t second = build(first + half, count - half, boxes);
    nodes_[node].second_child = second;
    return node;
}

double TriangleTree::nearest(const glm::mat4& world_from_mesh, glm::vec3 point, double limit) const {
    if (nodes_.empty()) return limit;
    struct Visit {
        uint32_t node;
        double distance;  ///< that nothing of the node is below
    };
    std::vector<Visit> open;
    const auto visit = [&](uint32_t node) {
        return Visit{node, nodes_[node].box.moved(world_from_mesh).nearest_to(glm::dvec3(point))};
    };
    double nearest = limit;
    for (open.push_back(visit(0)); !open.empty();) {
        const Visit at = open.back();
        open.pop_back();
        if (!(at.distance < nearest)) continue;
        const Node& node = nodes_[at.node];
        if (node.second_child == 0) {
            for (uint32_t i = node.first; i < node.first + node.count; ++i)
                nearest = std::min(nearest,
                                   distance_of(mesh_.indices, mesh_.vertices, triangles_[i], world_from_mesh, point));
            continue;
        }
        Visit nearer = visit(at.node + 1), farther = visit(node.second_child);
        if (farther.distance < nearer.distance) std::swap(nearer, farther);
        open.push_back(farther), open.push_back(nearer);
    }
    return nearest;
}
