#include "groundtruth/scene/camera_view.h"

#include <cmath>

namespace {

bool is_within(glm::vec2 point, glm::vec2 half_extent) {
    return std::abs(point.x) <= half_extent.x && std::abs(point.y) <= half_extent.y;
}

}  // namespace

CameraView::CameraView(const CameraPose& unfitted, glm::uvec2 extent)
    : is_orthographic_(unfitted.is_orthographic),
      view_from_world_(glm::inverse(glm::dmat4(unfitted.world_from_view))),
      eye_(unfitted.world_from_view[3]),
      backward_(glm::normalize(glm::vec3(unfitted.world_from_view[2]))),
      near_(unfitted.near),
      far_(unfitted.far) {
    const CameraPose pose = fitted(unfitted, double(extent.x) / extent.y);
    const float half_height =
        pose.is_orthographic ? 0.5f * pose.orthographic_height : std::tan(0.5f * pose.vertical_fov);
    half_extent_ = half_height * glm::vec2(float(extent.x) / float(extent.y), 1.0f);
}

bool CameraView::frames(glm::vec3 position) const {
    const glm::vec3 point = view_from_world_ * glm::vec4(position, 1.0f);
    const float distance = -point.z;
    return distance > 0 && distance >= near_ && distance < far_ &&
           is_within({point.x, point.y}, is_orthographic_ ? half_extent_ : half_extent_ * distance);
}

bool CameraView::frames_direction(glm::vec3 direction) const {
    const glm::vec3 towards = glm::mat3(view_from_world_) * direction;
    return !is_orthographic_ && towards.z < 0 && is_within({towards.x, towards.y}, half_extent_ * -towards.z);
}
