#pragma once
#include <glm/glm.hpp>

/// translation * rotation * scale; `rotation`: unit quaternion xyzw.
glm::mat4 transform(glm::vec3 translation, glm::vec4 rotation, glm::vec3 scale);

/// The parts of a matrix without shear; a mirrored one gets a negative scale along x.
void split_transform(const glm::mat4& matrix, glm::vec3& translation, glm::vec4& rotation, glm::vec3& scale);

/// Whether every number is within +-any_length (ranges.h); a NaN is not.
bool is_in_range(const glm::mat4& matrix);

/// Spherical linear interpolation along the shorter arc (glTF 2.0, appendix C.4).
glm::vec4 slerp(glm::vec4 from, glm::vec4 to, float t);
