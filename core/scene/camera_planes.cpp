#include "core/scene/camera_planes.h"

#include "core/error.h"
#include "core/scene/camera.h"
#include "core/scene/deform.h"
#include "core/scene/instance_bounds.h"
#include "core/scene/triangle_tree.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace {
constexpr float least_near = 1e-6f;  ///< of far: float32 depth has no more to give
constexpr float far_margin = 1.01f;
constexpr unsigned last_shown_frame = 1000000;

float farthest_corner(const std::array<glm::vec3, 2>& bounds, glm::vec3 eye) {
    return glm::length(glm::max(glm::abs(bounds[0] - eye), glm::abs(bounds[1] - eye)));
}

/// By how many times a point in the corner of the picture is farther from the eye than its depth.
float corner_stretch(const SceneCamera& camera) {
    const float edge = std::tan(0.5f * camera.vertical_fov) * std::max(1.0f, camera.aspect);
    return std::sqrt(1.0f + edge * edge * (1.0f + 2.0f * 2.0f));
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

/// The first frame from which on animation stands still.
unsigned end_of_animation(const Scene& scene) {
    float last = 0.0f;
    for (const AnimationChannel& channel : scene.animation) last = std::max(last, channel.times.back());
    return unsigned(std::clamp(std::ceil(double(last) * double(scene.frame_rate)), 0.0, double(last_shown_frame)));
}

/// What is nearest to the eye and farthest from it, frame by frame.
class Distances {
public:
    /// Both must outlive this. `many`: so many frames will be asked for that trees over the triangles pay.
    Distances(const SceneCamera& camera, const Scene& scene, bool many)
        : camera_(camera), scene_(scene), bounds_(scene), trees_(scene.meshes.size()) {
        if (!many) return;
        std::vector<unsigned char> is_drawn(scene.meshes.size(), 0);
        for (const Instance& instance : scene.instances)
            if (!deforms(scene, instance)) is_drawn[instance.mesh] = 1;
        tbb::parallel_for(size_t(0), trees_.size(), [&](size_t i) {
            if (is_drawn[i] && scene.meshes[i].indices.size() / 3 >= least_triangles_of_tree)
                trees_[i].emplace(scene.meshes[i]);
        });
    }

    glm::vec3 eye(const ScenePose& pose, float frame) const {
        if (camera_.node >= 0) return pose.world_from_node[size_t(camera_.node)][3];
        return pose_camera(camera_, pose, frame).world_from_view[3];
    }

    /// Distance (m) of the nearest surface, or `limit` where none is below.
    double nearest(const ScenePose& pose, glm::vec3 eye, double limit) const {
        for (size_t i = 0; i < scene_.instances.size(); ++i) {
            if (bounds_.at(pose, i).nearest_to(eye) >= limit) continue;
            const unsigned mesh = scene_.instances[i].mesh;
            const glm::mat4& matrix = pose.world_from_instance[i];
            if (trees_[mesh] && !deforms(scene_, scene_.instances[i])) {
                limit = trees_[mesh]->nearest(matrix, eye, limit);
                continue;
            }
            std::vector<Vertex> deformed;
            const std::span<const Vertex> vertices = posed_vertices(scene_, pose, i, deformed);
            limit = std::min(limit, nearest_distance(scene_.meshes[mesh].indices, vertices, matrix, eye));
        }
        return limit;
    }

    /// Distance (m) of the farthest vertex, or `limit` where none is above.
    double farthest(const ScenePose& pose, glm::vec3 eye, double limit) const {
        for (size_t i = 0; i < scene_.instances.size(); ++i) {
            if (bounds_.at(pose, i).farthest_from(eye) <= limit) continue;
            std::vector<Vertex> deformed;
            const std::span<const Vertex> vertices = posed_vertices(scene_, pose, i, deformed);
            for (const uint32_t index : scene_.meshes[scene_.instances[i].mesh].indices) {
                const glm::vec3 p = pose.world_from_instance[i] * glm::vec4(vertices[index].position, 1.0f);
                limit = std::max(limit, glm::distance(glm::dvec3(p), glm::dvec3(eye)));
            }
        }
        return limit;
    }

private:
    static constexpr size_t least_triangles_of_tree = 64;
    const SceneCamera& camera_;
    const Scene& scene_;
    InstanceBounds bounds_;
    std::vector<std::optional<TriangleTree>> trees_;  ///< of meshes with many triangles
};

/// The least distance from the eye in the frames in which the camera alone moves, from `first` on: `enough` where none
/// is below it, else a distance below it of which no frame has less than half. One frame stands for all those that the
/// camera reaches from it without coming so near, so that a path takes about as many steps as its length over that
/// distance.
double least_on_path(const Distances& distances, const SceneCamera& camera, const ScenePose& pose, unsigned first,
                     double enough, double floor) {
    std::vector<unsigned> ends = {first};  // between two of them the camera goes straight on
    for (const CameraKey& key : camera.keys)
        for (const float frame : {std::floor(key.frame), std::ceil(key.frame)})
            if (frame > float(ends.back())) ends.push_back(unsigned(frame));
    struct Span {
        unsigned first, last;
    };
    std::vector<Span> open;
    for (size_t i = 0; i < ends.size(); ++i) open.push_back({ends[i > 0 ? i - 1 : 0], ends[i]});
    double least = enough;
    while (!open.empty() && least > floor) {
        const Span span = open.back();
        open.pop_back();
        const unsigned middle = span.first + (span.last - span.first) / 2;
        const auto eye = [&](unsigned frame) { return distances.eye(pose, float(frame)); };
        const double reach =
            std::max(glm::distance(eye(span.first), eye(middle)), glm::distance(eye(span.last), eye(middle)));
        const double known = least < enough ? 0.5 * least : enough;  // what is above it is all the same
        const double nearest = distances.nearest(pose, eye(middle), known + reach);
        if (nearest >= known + reach) continue;
        if (nearest < enough) least = std::min(least, nearest);
        if (middle > span.first) open.push_back({span.first, middle - 1});
        if (middle < span.last) open.push_back({middle + 1, span.last});
    }
    return least;
}

struct Extremes {
    double nearest, farthest;
};

/// Of all frames: `known.nearest` where nothing comes nearer, `known.farthest` where nothing goes farther.
Extremes extremes_of_all_frames(const Distances& distances, const SceneCamera& camera, const Scene& scene,
                                const Extremes& known, double floor) {
    const unsigned end = scene.animation.empty() ? 0 : end_of_animation(scene);
    const auto look = [&](const tbb::blocked_range<unsigned>& frames, Extremes found) {
        for (unsigned frame = frames.begin(); frame < frames.end(); ++frame) try {
                const ScenePose pose = pose_scene(scene, float(frame));
                const glm::vec3 eye = distances.eye(pose, float(frame));
                found = {std::min(found.nearest, distances.nearest(pose, eye, known.nearest)),
                         std::max(found.farthest, distances.farthest(pose, eye, known.farthest))};
            } catch (const Error&) {
                // A frame without a pose is shown by nobody: who asks for it hears why.
            }
        return found;
    };
    Extremes found = known;
    if (!scene.animation.empty())
        found = tbb::parallel_reduce(
            tbb::blocked_range<unsigned>(0, end + 1), known, look, [](const Extremes& a, const Extremes& b) {
                return Extremes{std::min(a.nearest, b.nearest), std::max(a.farthest, b.farthest)};
            });
    // Then the camera alone moves, straight between keys: nothing is farther from it than at one of its ends.
    const ScenePose last = pose_scene(scene, float(end));
    for (const CameraKey& key : camera.keys)
        found.farthest =
            std::max(found.farthest, distances.farthest(last, distances.eye(last, key.frame), known.farthest));
    if (camera.keys.size() > 1)
        found.nearest = std::min(found.nearest, least_on_path(distances, camera, last, end, known.nearest, floor));
    return found;
}

bool moves(const SceneCamera& camera, const Scene& scene) { return !scene.animation.empty() || camera.keys.size() > 1; }

CameraPlanes widened(const CameraPlanes& planes, const SceneCamera& camera, const Scene& scene,
                     const Distances& distances) {
    const float stretch = camera.is_orthographic ? 1.0f : corner_stretch(camera);
    // Nothing is nearer to an orthographic camera's plane than 0, and no near plane is below its least.
    const bool near_holds = camera.is_orthographic || planes.near <= least_near * planes.far;
    const Extremes known{near_holds ? 0.0 : double(planes.near) * double(stretch), planes.far};
    const double floor = 2.0 * double(least_near) * double(stretch) * double(planes.far);
    const Extremes found = extremes_of_all_frames(distances, camera, scene, known, floor);
    CameraPlanes result = planes;
    if (found.farthest > known.farthest) result.far = far_margin * float(found.farthest);
    if (found.nearest < known.nearest)
        result.near = std::max(0.5f * float(found.nearest) / stretch, least_near * result.far);
    return result;
}

/// From the frames that are looked at.
float farthest_of(const std::vector<float>& frames, const SceneCamera& camera, const Scene& scene) {
    float farthest = 0.0f;
    if (scene.triangle_count() == 0) return farthest;
    for (const float frame : frames) {
        const ScenePose pose = pose_scene(scene, frame);
        const glm::vec3 eye = pose_camera(camera, pose, frame).world_from_view[3];
        farthest = std::max(farthest, farthest_corner(scene_bounds(scene, pose), eye));
    }
    return farthest;
}
}  // namespace

CameraPlanes planes_for_all_frames(const CameraPlanes& planes, const SceneCamera& camera, const Scene& scene) {
    if (!moves(camera, scene) || scene.triangle_count() == 0) return planes;
    return widened(planes, camera, scene, Distances(camera, scene, true));
}

CameraPlanes derive_planes(const SceneCamera& camera, const Scene& scene) {
    const std::vector<float> frames = frames_to_look_at(camera, scene);
    const float farthest = farthest_of(frames, camera, scene);
    if (!(farthest > 0.0f)) return {0.1f, 100.0f};
    const Distances distances(camera, scene, moves(camera, scene));
    CameraPlanes planes{0.0f, far_margin * farthest};
    if (!camera.is_orthographic) {
        double nearest = std::numeric_limits<double>::infinity();
        for (const float frame : frames) {
            const ScenePose pose = pose_scene(scene, frame);
            nearest = distances.nearest(pose, distances.eye(pose, frame), nearest);
        }
        planes.near = std::max(0.5f * (float(nearest) / corner_stretch(camera)), least_near * planes.far);
    }
    return moves(camera, scene) ? widened(planes, camera, scene, distances) : planes;
}

float derive_far(const SceneCamera& camera, const Scene& scene) {
    const float farthest = farthest_of(frames_to_look_at(camera, scene), camera, scene);
    if (!(farthest > 0.0f)) return 100.0f;
    const CameraPlanes planes{0.0f, far_margin * farthest};  // near is no matter
    return planes_for_all_frames(planes, camera, scene).far;
}

void use_planes_of_scene(SceneCamera& camera, const Scene& scene) {
    const CameraPlanes planes = derive_planes(camera, scene);
    camera.near = planes.near, camera.far = planes.far;
}
