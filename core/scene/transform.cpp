#include "core/scene/transform.h"

#include "core/scene/ranges.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>

namespace {
glm::quat quaternion(glm::vec4 xyzw) { return {xyzw.w, xyzw.x, xyzw.y, xyzw.z}; }
glm::vec4 xyzw(glm::quat q) { return {q.x, q.y, q.z, q.w}; }
}  // namespace

glm::mat4 transform(glm::vec3 translation, glm::vec4 rotation, glm::vec3 scale) {
    const glm::mat3 turn = glm::mat3_cast(quaternion(rotation));
    return glm::mat4(glm::vec4(turn[0] * scale.x, 0.0f), glm::vec4(turn[1] * scale.y, 0.0f),
                     glm::vec4(turn[2] * scale.z, 0.0f), glm::vec4(translation, 1.0f));
}

NormalTransform normal_transform(const glm::mat4& world_from_object) {
    // Products of floats are exact in double precision.
    const glm::dmat3 m(world_from_object);
    const glm::dmat3 cofactors(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1]));
    const double determinant = glm::dot(m[0], cofactors[0]);
    const double columns = glm::length(m[0]) * glm::length(m[1]) * glm::length(m[2]);
    NormalTransform result;
    result.is_flat = !(std::abs(determinant) > 1e-6 * columns);
    result.is_mirrored = !result.is_flat && determinant < 0;
    double largest = 0;
    for (int column = 0; column < 3; ++column)
        for (int row = 0; row < 3; ++row) largest = std::max(largest, std::abs(cofactors[column][row]));
    result.matrix = largest > 0 ? glm::mat3(cofactors * ((result.is_mirrored ? -1 : 1) / largest)) : glm::mat3(0.0f);
    return result;
}

glm::vec3 direction_or_zero(glm::vec3 v) {
    const float largest = std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
    if (!(largest > 0.0f) || !std::isfinite(largest)) return glm::vec3(0.0f);
    v /= largest;  // before squaring, which would underflow for the triangles of a scene of millimetres
    return v / glm::length(v);
}

glm::vec3 any_perpendicular(glm::vec3 n) {
    const float sign = std::copysign(1.0f, n.z);
    const float a = -1.0f / (sign + n.z);
    return {1.0f + sign * n.x * n.x * a, sign * n.x * n.y * a, -sign * n.x};
}

void split_transform(const glm::mat4& matrix, glm::vec3& translation, glm::vec4& rotation, glm::vec3& scale) {
    translation = matrix[3];
    glm::mat3 axes(matrix);
    for (int i = 0; i < 3; ++i) scale[i] = glm::length(axes[i]);
    if (glm::determinant(axes) < 0.0f) scale.x = -scale.x;
    rotation = {0.0f, 0.0f, 0.0f, 1.0f};
    if (scale.x == 0.0f || scale.y == 0.0f || scale.z == 0.0f) return;
    for (int i = 0; i < 3; ++i) axes[i] /= scale[i];
    rotation = xyzw(glm::normalize(glm::quat_cast(axes)));
}

bool is_in_range(const glm::mat4& matrix) {
    for (int column = 0; column < 4; ++column)
        for (int row = 0; row < 4; ++row)
            if (!(std::abs(matrix[column][row]) <= any_length)) return false;
    return true;
}

glm::vec4 slerp(glm::vec4 from, glm::vec4 to, float t) {
    return xyzw(glm::normalize(glm::slerp(quaternion(from), quaternion(to), t)));
}
