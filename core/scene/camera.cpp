#include "core/scene/camera.h"

#include "core/error.h"

#include <algorithm>
#include <cmath>

namespace {
CameraKey interpolated_key(const std::vector<CameraKey>& keys, float frame) {
    const auto after = std::ranges::upper_bound(keys, frame, {}, &CameraKey::frame);
    if (after == keys.begin()) return keys.front();
    if (after == keys.end()) return keys.back();
    const CameraKey &a = *(after - 1), &b = *after;
    const float t = (frame - a.frame) / (b.frame - a.frame);
    return {frame, glm::mix(a.position, b.position, t), glm::mix(a.target, b.target, t), glm::mix(a.up, b.up, t)};
}

/// In double precision, since targets may be a thousand kilometres away and eyes a millimetre.
glm::mat4 looking(const CameraKey& key) {
    const glm::dvec3 back = glm::normalize(glm::dvec3(key.position) - glm::dvec3(key.target));
    glm::dvec3 right = glm::cross(glm::dvec3(key.up), back);
    if (glm::length(right) < 1e-9)
        right = glm::cross(std::abs(back.z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0), back);
    right = glm::normalize(right);
    const glm::dvec3 up = glm::cross(back, right);
    return glm::mat4(glm::vec4(right, 0.0f), glm::vec4(up, 0.0f), glm::vec4(back, 0.0f), glm::vec4(key.position, 1.0f));
}

/// The node's position and orientation without its scale (glTF 2.0, section 3.10.1), and without its mirroring.
glm::mat4 without_scale(const glm::mat4& world_from_node) {
    const glm::vec3 back = glm::normalize(glm::vec3(world_from_node[2]));
    const glm::vec3 right = glm::normalize(glm::cross(glm::vec3(world_from_node[1]), back));
    return glm::mat4(glm::vec4(right, 0.0f), glm::vec4(glm::cross(back, right), 0.0f), glm::vec4(back, 0.0f),
                     world_from_node[3]);
}

float aspect_of(glm::uvec2 extent) { return float(extent.x) / float(extent.y); }

/// clip_from_view in double precision: inverting the float one would lose the far end of a deep reversed depth range.
glm::dmat4 projection(const CameraPose& unfitted, double aspect, DepthDirection direction) {
    const CameraPose pose = fitted(unfitted, aspect);
    const double near = pose.near, far = pose.far;
    glm::dmat4 clip_from_view(0.0);
    if (pose.is_orthographic) {
        clip_from_view[0][0] = 2.0 / (pose.orthographic_height * aspect);
        clip_from_view[1][1] = -2.0 / pose.orthographic_height;
        clip_from_view[2][2] = -1.0 / (far - near);
        clip_from_view[3][2] = -near / (far - near);
        clip_from_view[3][3] = 1.0;
    } else {
        const double focal = 1.0 / std::tan(0.5 * pose.vertical_fov);
        clip_from_view[0][0] = focal / aspect;
        clip_from_view[1][1] = -focal;
        clip_from_view[2][2] = -far / (far - near);
        clip_from_view[3][2] = -far * near / (far - near);
        clip_from_view[2][3] = -1.0;
    }
    if (direction == DepthDirection::reversed)  // z' = w - z
        for (int column = 0; column < 4; ++column)
            clip_from_view[column][2] = clip_from_view[column][3] - clip_from_view[column][2];
    return clip_from_view;
}
}  // namespace

CameraPose pose_camera(const SceneCamera& camera, const ScenePose& scene_pose, float frame) {
    CameraPose pose{.is_orthographic = camera.is_orthographic,
                    .vertical_fov = camera.vertical_fov,
                    .orthographic_height = camera.orthographic_height,
                    .near = camera.near,
                    .far = camera.far,
                    .aspect = camera.aspect};
    pose.world_from_view = camera.node >= 0 ? without_scale(scene_pose.world_from_node[size_t(camera.node)])
                                            : looking(interpolated_key(camera.keys, frame));
    if (!(glm::length(glm::vec3(pose.world_from_view[0])) > 0.0f))  // a NaN is not, either
        fail("camera '", camera.name, "' hangs on a node with a scale of 0: it has no orientation");
    return pose;
}

CameraPose fitted(const CameraPose& pose, double image_aspect) {
    CameraPose result = pose;
    result.aspect = 0.0f;
    // Their own rounding is no difference: 16:9 in float32 and in a file's decimals.
    if (!(double(pose.aspect) > image_aspect * (1.0 + 1e-6))) return result;
    const double growth = double(pose.aspect) / image_aspect;
    result.orthographic_height = float(double(pose.orthographic_height) * growth);
    result.vertical_fov = float(2.0 * std::atan(std::tan(0.5 * double(pose.vertical_fov)) * growth));
    return result;
}

glm::mat4 clip_from_view(const CameraPose& pose, float aspect, DepthDirection direction) {
    return glm::mat4(projection(pose, aspect, direction));
}

CameraData camera_data(const CameraPose& pose, const CameraPose* previous, const FrameView& view) {
    const bool is_reversed = view.depth_direction == DepthDirection::reversed;
    const CameraPose& before = previous ? *previous : pose;
    const double aspect = double(view.extent.x) / view.extent.y;
    const glm::dmat4 clip_from_view = projection(pose, aspect, view.depth_direction);
    const glm::dmat4 view_from_world = glm::inverse(glm::dmat4(pose.world_from_view));
    const glm::dmat4 previous_clip_from_view = projection(before, aspect, view.depth_direction);
    const glm::dmat4 previous_view_from_world = glm::inverse(glm::dmat4(before.world_from_view));
    const glm::vec2 extent(view.extent);
    return {.clip_from_view = glm::mat4(clip_from_view),
            .view_from_clip = glm::mat4(glm::inverse(clip_from_view)),
            .view_from_world = glm::mat4(view_from_world),
            .world_from_view = pose.world_from_view,
            .clip_from_world = glm::mat4(clip_from_view * view_from_world),
            .world_from_clip = glm::mat4(glm::dmat4(pose.world_from_view) * glm::inverse(clip_from_view)),
            .previous_clip_from_world = glm::mat4(previous_clip_from_view * previous_view_from_world),
            .previous_view_from_world = glm::mat4(previous_view_from_world),
            .previous_world_from_view = before.world_from_view,
            .previous_view_from_clip = glm::mat4(glm::inverse(previous_clip_from_view)),
            .extent = {extent, 1.0f / extent},
            .depth = {pose.near, pose.far, is_reversed ? 0.0f : 1.0f, is_reversed ? 1.0f : 0.0f},
            .jitter = {view.jitter, view.previous_jitter},
            .frame = {view.rendered_index(), view.seed, pose.is_orthographic, previous != nullptr}};
}

CameraRay camera_ray(const CameraPose& unfitted, glm::uvec2 extent, glm::vec2 pixel) {
    const float aspect = aspect_of(extent);
    const CameraPose pose = fitted(unfitted, double(aspect));
    const glm::vec2 ndc = 2.0f * pixel / glm::vec2(extent) - 1.0f;  // y down
    if (pose.is_orthographic) {
        const glm::vec2 half = 0.5f * pose.orthographic_height * glm::vec2(aspect, 1.0f);
        const glm::vec3 origin = pose.world_from_view * glm::vec4(ndc.x * half.x, -ndc.y * half.y, 0.0f, 1.0f);
        return {origin, -glm::normalize(glm::vec3(pose.world_from_view[2]))};
    }
    const float tangent = std::tan(0.5f * pose.vertical_fov);
    const glm::vec3 direction =
        glm::mat3(pose.world_from_view) * glm::vec3(ndc.x * tangent * aspect, -ndc.y * tangent, -1.0f);
    return {glm::vec3(pose.world_from_view[3]), glm::normalize(direction)};
}

float view_distance(const CameraData& camera, float device_depth) {
    const float near = camera.depth.x, far = camera.depth.y;
    const float from_near = camera.depth.w != 0.0f ? 1.0f - device_depth : device_depth;  // 0 at near, 1 at far
    const float from_far = camera.depth.w != 0.0f ? device_depth : 1.0f - device_depth;
    if (camera.frame.z != 0u) return near * from_far + far * from_near;
    return near * far / (far * from_far + near * from_near);
}
