#pragma once
#include "core/scene/camera.h"

/// The points that a camera's image can show: between the clip planes, within the borders. Rays start at the eye, or on
/// the plane through it for an orthographic camera, as those of camera_ray().
class CameraView {
public:
    CameraView(const CameraPose& pose, glm::uvec2 extent);

    /// The vector (m, world space) from a point to the start of the camera ray towards it. Branchless, for vector
    /// loops.
    glm::vec3 to_eye(glm::vec3 position) const {
        const glm::vec3 to_eye = eye_ - position;
        const float along_axis = glm::dot(to_eye, backward_);
        return {is_orthographic_ ? along_axis * backward_.x : to_eye.x,
                is_orthographic_ ? along_axis * backward_.y : to_eye.y,
                is_orthographic_ ? along_axis * backward_.z : to_eye.z};
    }
    glm::vec3 eye() const { return eye_; }
    float near() const { return near_; }  ///< m, along the axis
    float far() const { return far_; }
    float depth(glm::vec3 position) const { return glm::dot(eye_ - position, backward_); }  ///< m, along the axis
    /// The depth of a unit step in this direction.
    float cosine(glm::vec3 direction) const { return -glm::dot(direction, backward_); }

    bool frames(glm::vec3 position) const;  ///< world space (m); hidden or not
    /// Whether the image shows points infinitely far along `direction`. An orthographic camera shows at most one
    /// direction, which no sample has.
    bool frames_direction(glm::vec3 direction) const;

private:
    bool is_orthographic_;
    glm::mat4 view_from_world_;
    glm::vec3 eye_, backward_;  ///< world space; backward: unit, along the view's +z
    glm::vec2 half_extent_;     ///< of the image: at distance 1, or, orthographic, in m
    float near_, far_;
};
