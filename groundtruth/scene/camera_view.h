#pragma once
#include "core/scene/camera.h"

/// Which points are in front of a camera, as for camera_ray(): from the eye on (an orthographic camera: from the
/// plane through it), independent of the clip planes, within the borders of the image.
class CameraView {
public:
    CameraView(const CameraPose& pose, glm::uvec2 extent);

    /// From a point to where a camera ray towards it starts (m), world space. Branchless, for vector loops.
    glm::vec3 to_eye(glm::vec3 position) const {
        const glm::vec3 to_eye = eye_ - position;
        const float along_axis = glm::dot(to_eye, backward_);
        return {is_orthographic_ ? along_axis * backward_.x : to_eye.x,
                is_orthographic_ ? along_axis * backward_.y : to_eye.y,
                is_orthographic_ ? along_axis * backward_.z : to_eye.z};
    }
    glm::vec3 eye() const { return eye_; }

    bool frames(glm::vec3 position) const;  ///< world space (m); hidden or not
    /// Whether the image shows what is infinitely far along `direction`. An orthographic camera shows one direction at
    /// most, which no sample ever has.
    bool frames_direction(glm::vec3 direction) const;

private:
    bool is_orthographic_;
    glm::mat4 view_from_world_;
    glm::vec3 eye_, backward_;  ///< world space; backward: unit, along the view's +z
    glm::vec2 half_extent_;     ///< of the image: at distance 1, or, orthographic, in m
};
