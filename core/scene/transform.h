#pragma once
#include <glm/glm.hpp>

/// translation * rotation * scale; `rotation`: unit quaternion xyzw.
glm::mat4 transform(glm::vec3 translation, glm::vec4 rotation, glm::vec3 scale);

/// How a transform moves normals. Defined for every matrix, also for those without an inverse.
struct NormalTransform {
    /// Keeps normals of any length on their side of the surface; normalise them after interpolation. It is the cofactor
    /// matrix (the inverse transpose but for a factor) with the sign of the determinant and a largest entry of 1. If
    /// the transform flattens all to a plane, normals become the plane's or zero; if it leaves no area, zero.
    glm::mat3 matrix{1.0f};
    bool is_mirrored = false;  ///< negative determinant; never if flat
    bool is_flat = false;      ///< no inverse in float32: the volume is below 1e-6 of that of the matrix's columns
};
NormalTransform normal_transform(const glm::mat4& world_from_object);

/// `v` with unit length; zero if `v` has no direction, that is, is zero or not finite.
glm::vec3 direction_or_zero(glm::vec3 v);

/// Unit and perpendicular to the unit vector `n` (Duff et al., "Building an Orthonormal Basis, Revisited", JCGT 2017).
glm::vec3 any_perpendicular(glm::vec3 n);

/// The parts of a matrix without shear; a mirrored one gets a negative scale along x.
void split_transform(const glm::mat4& matrix, glm::vec3& translation, glm::vec4& rotation, glm::vec3& scale);

/// Whether every number is within +-any_length (ranges.h); a NaN is not.
bool is_in_range(const glm::mat4& matrix);

/// Spherical linear interpolation along the shorter arc (glTF 2.0, appendix C.4).
glm::vec4 slerp(glm::vec4 from, glm::vec4 to, float t);
