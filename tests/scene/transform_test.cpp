#include "core/scene/transform.h"

#include <gtest/gtest.h>
#include <glm/gtc/matrix_transform.hpp>
#include <random>

namespace {

glm::dvec3 random_vector(std::mt19937& random) {
    std::uniform_real_distribution<double> uniform(-1, 1);
    const double x = uniform(random), y = uniform(random), z = uniform(random);
    return {x, y, z};
}

/// Against what defines a normal: the cross product of two moved edges, turned where mirroring swaps their order. The
/// scale is that of the matrix's largest entry, so tolerances are a few float32 roundings of 1.
void expect_normals_of_moved_triangles(const glm::mat4& matrix, std::mt19937& random) {
    const NormalTransform found = normal_transform(matrix);
    const glm::dmat3 linear(matrix);
    for (int i = 0; i < 100; ++i) {
        const glm::dvec3 a = random_vector(random), b = random_vector(random);
        const glm::dvec3 moved = glm::cross(linear * a, linear * b) * (found.is_mirrored ? -1.0 : 1.0);
        const glm::dvec3 normal = glm::dmat3(found.matrix) * glm::cross(a, b);
        if (glm::length(moved) == 0) {
            EXPECT_LT(glm::length(normal), 1e-6);
            continue;
        }
        EXPECT_NEAR(glm::length(glm::cross(normal, glm::normalize(moved))), 0, 1e-6);
        EXPECT_GE(glm::dot(normal, moved), 0);
    }
}

}  // namespace

TEST(normal_transform, gives_the_normals_of_moved_triangles) {
    std::mt19937 random(7);
    const glm::mat4 turn = glm::rotate(glm::mat4(1.0f), 0.7f, glm::vec3(0.6f, 0.8f, 0));
    for (const glm::vec3 scale : {glm::vec3(1), glm::vec3(1e-6f), glm::vec3(1e6f), glm::vec3(-1, 1, 1),
                                  glm::vec3(2, -3, -0.1f), glm::vec3(-1, -2, -3), glm::vec3(1, 1, 1e-3f),
                                  glm::vec3(1, 0, 1), glm::vec3(0, -2, 3), glm::vec3(1, 0, 0), glm::vec3(0)}) {
        SCOPED_TRACE(testing::Message() << "scale " << scale.x << ", " << scale.y << ", " << scale.z);
        const glm::mat4 scaled = glm::scale(glm::mat4(1.0f), scale);
        const bool is_flat = scale.x * scale.y * scale.z == 0, is_mirrored = scale.x * scale.y * scale.z < 0;
        for (const glm::mat4& matrix : {scaled, turn * scaled, scaled * turn}) {
            expect_normals_of_moved_triangles(matrix, random);
            EXPECT_EQ(normal_transform(matrix).is_flat, is_flat);
            EXPECT_EQ(normal_transform(matrix).is_mirrored, is_mirrored);
        }
    }
    // Rounding decides the sign of this determinant, and must not decide which side is the front.
    const glm::mat4 rounded = turn * glm::scale(glm::mat4(1.0f), glm::vec3(1, 0, 1)) * turn;
    EXPECT_TRUE(normal_transform(rounded).is_flat);
    EXPECT_FALSE(normal_transform(rounded).is_mirrored);
}
