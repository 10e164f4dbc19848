#pragma once
#include "core/scene/scene.h"
#include "core/shared/camera.h"

#include <optional>

/// How depth is stored: precision is one of the things that ssrlab studies.
enum class DepthFormat { d32f, d24, d16 };
enum class DepthDirection { standard, reversed };

/// A camera at one instant.
struct CameraPose {
    glm::mat4 world_from_view{1.0f};  ///< view looks along -z, y up
    bool is_orthographic = false;
    float vertical_fov = 0.87f;        ///< radians
    float orthographic_height = 1.0f;  ///< m
    float near = 0.1f, far = 100.0f;   ///< m, along -z
    float aspect = 0.0f;               ///< SceneCamera::aspect; 0: the height of the field holds in every image
};

/// The pose with its field of view in an image of this aspect (width over height), and without an aspect of its own. In
/// an image narrower than the author's frame, the field grows in height until the frame's width fits: clients should
/// not crop (glTF 2.0, sections 3.10.3.2 to 3.10.3.4). Functions with a pose and an extent or an aspect call it
/// themselves.
CameraPose fitted(const CameraPose& pose, double image_aspect);

/// The pose at a frame, which may be fractional. Fails with Error if the camera's node has a scale of 0.
CameraPose pose_camera(const SceneCamera& camera, const ScenePose& scene_pose, float frame);

struct FrameView {
    glm::uvec2 extent{0, 0};
    DepthDirection depth_direction = DepthDirection::standard;
    unsigned frame = 0, seed = 0;                   ///< `frame`: which pose of camera and scene
    glm::vec2 jitter{0.0f}, previous_jitter{0.0f};  ///< pixels, y down: samples lie at pixel centre + jitter

    /// For frames rendered in a row whose poses do not count up by one: held, warmed up, or jumping.
    std::optional<unsigned> index;           ///< how many frames were rendered before; none: `frame` many
    std::optional<unsigned> previous_frame;  ///< pose of the one before; none: frame - 1. Not looked at if index is 0

    /// How many frames were rendered before this one.
    unsigned rendered_index() const { return index.value_or(frame); }
    /// Pose of the frame rendered before; none for the first.
    std::optional<unsigned> predecessor() const {
        if (rendered_index() == 0) return std::nullopt;
        return previous_frame.value_or(frame > 0 ? frame - 1 : 0);
    }
};

/// The block which shaders see. `previous` is the pose of the frame rendered before, or nullptr for the first frame.
CameraData camera_data(const CameraPose& pose, const CameraPose* previous, const FrameView& view);

/// Vulkan clip space: y down, z in [0, 1], near plane at 0 (standard) or 1 (reversed).
glm::mat4 clip_from_view(const CameraPose& pose, float aspect, DepthDirection direction);

/// The ray through a point of the image (pixels, y down; the centre of the first pixel is (0.5, 0.5)), in world space.
/// Perspective rays start at the eye, orthographic ones on the plane through it. `direction` has unit length.
struct CameraRay {
    glm::vec3 origin, direction;
};
CameraRay camera_ray(const CameraPose& pose, glm::uvec2 extent, glm::vec2 pixel);

/// Distance along -z of a view-space point from its device depth.
float view_distance(const CameraData& camera, float device_depth);
