#include "core/scene/camera_planes.h"

#include "core/scene/camera.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>
#include <algorithm>
#include <cmath>
#include <limits>

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

float nearest_distance(const Mesh& mesh, const glm::mat4& world_from_mesh, glm::vec3 eye) {
    const auto nearer = [&](const tbb::blocked_range<size_t>& triangles, double nearest) {
        for (size_t i = triangles.begin(); i < triangles.end(); ++i) {
            const auto corner = [&](size_t k) {
                return glm::dvec3(world_from_mesh * glm::vec4(mesh.vertices[mesh.indices[i * 3 + k]].position, 1.0f));
            };
            nearest =
                std::min(nearest, glm::distance(glm::dvec3(eye), closest_point(eye, corner(0), corner(1), corner(2))));
        }
        return nearest;
    };
    const tbb::blocked_range<size_t> all(0, mesh.indices.size() / 3, 4096);
    return float(tbb::parallel_reduce(all, std::numeric_limits<double>::infinity(), nearer,
                                      [](double a, double b) { return std::min(a, b); }));
}

float farthest_corner(const std::array<glm::vec3, 2>& bounds, glm::vec3 eye) {
    return glm::length(glm::max(glm::abs(bounds[0] - eye), glm::abs(bounds[1] - eye)));
}

std::vector<float> frames_to_look_at(const SceneCamera& camera, const Scene& scene) {
    std::vector<float> frames;
    for (const CameraKey& key : camera.keys) frames.push_back(key.frame);
    const unsigned count = std::max(camera.frame_count, scene.animation.empty() ? 1u : scene.frame_count);
    const bool moves = !scene.animation.empty() || camera.keys.size() > 1;
    const int steps = moves && count > 1 ? 8 : 0;
    for (int i = 0; i <= steps; ++i) frames.push_back(float(count - 1) * float(i) / 8.0f);
    return frames;
}
}  // namespace

CameraPlanes derive_planes(const SceneCamera& camera, const Scene& scene) {
    float nearest = std::numeric_limits<float>::infinity(), farthest = 0.0f;
    for (const float frame : frames_to_look_at(camera, scene)) {
        const ScenePose pose = pose_scene(scene, frame);
        const glm::vec3 eye = pose_camera(camera, pose, frame).world_from_view[3];
        if (scene.triangle_count() > 0) farthest = std::max(farthest, farthest_corner(scene_bounds(scene, pose), eye));
        for (size_t i = 0; i < scene.instances.size(); ++i)
            nearest = std::min(
                nearest, nearest_distance(scene.meshes[scene.instances[i].mesh], pose.world_from_instance[i], eye));
    }
    if (!(farthest > 0.0f)) return {0.1f, 100.0f};
    const float far = 1.01f * farthest;
    if (camera.is_orthographic) return {0.0f, far};
    const float edge = std::tan(0.5f * camera.vertical_fov);
    const float depth_in_corner = nearest / std::sqrt(1.0f + edge * edge * (1.0f + 2.0f * 2.0f));
    return {std::max(0.5f * depth_in_corner, 1e-6f * far), far};
}
