// Lets the headers of this folder compile both as C++ (with GLM) and as GLSL, so that the path tracer, the G-buffer and
// every technique evaluate the very same formulas.
#ifdef __cplusplus
#pragma once
#include <cmath>
#include <glm/glm.hpp>
#define SHARED inline
#define OUT(type) type&
using glm::abs, glm::clamp, glm::cos, glm::cross, glm::dot, glm::floor, glm::length, glm::max, glm::min, glm::mix,
    glm::normalize, glm::sin, glm::sqrt;
using glm::mat3, glm::mat4, glm::uvec2, glm::uvec4, glm::vec2, glm::vec3, glm::vec4;
#else
#define SHARED
#define OUT(type) out type
#endif
