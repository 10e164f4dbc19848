#pragma once
#include "tests/variants/denoiser_bench.h"
#include "tests/variants/technique_fixture.h"
#include "variants/common/ggx_lobe.h"

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <random>

inline const nlohmann::json of_means = {{"reuse_neighbors", false}, {"change_deviations", 0.0}};

/// A wall that faces the camera, and rays drawn from its lobe.
struct RatioAccumulationTest : TechniqueTest {
    static constexpr float wall_distance = 5;
    glm::uvec2 extent{16, 12};
    CameraPose pose{.vertical_fov = 1.2f, .near = 0.1f, .far = 100.0f};
    float roughness = 0.3f;
    std::mt19937 random{1};
    std::uniform_real_distribution<float> uniform{0, 1};

    SyntheticHit wall(const CameraRay& ray) const {
        return {.distance = (-wall_distance - ray.origin.z) / ray.direction.z,
                .normal = {0, 0, 1},
                .roughness = roughness,
                .metalness = 1,
                .specular = 1};
    }
    DenoiserBench bench(const nlohmann::json& own, const nlohmann::json& of_technique = nlohmann::json::object()) {
        return {device(), "ratio_accumulation", pose, extent, [this](const CameraRay& ray) { return wall(ray); },
                own,      of_technique};
    }
    void move_to(DenoiserBench& bench, glm::vec3 place) const {
        bench.pose.world_from_view = glm::translate(glm::mat4(1), place);
    }

    /// Gives mirrored rays the density of the lobe at its peak, so that their own pixel's ratio is 1.
    std::function<void(glm::uvec2, StoredRay&)> drawn_from_lobe() const {
        return [this](glm::uvec2, StoredRay& ray) {
            const float cosine = ray.direction.z;
            const glm::vec3 o(std::sqrt(1 - cosine * cosine), 0, cosine), peak(0, 0, 1);
            ray.inverse_density = 1 / density_of_reflection(lobe_of_visible_normals, o, peak, ggx_alpha(roughness));
        };
    }
    RayFrame drawn(const std::function<glm::vec3(glm::uvec2)>& color) const {
        return {.color = color, .motion = [](glm::uvec2) { return glm::vec2(0); }, .change = drawn_from_lobe()};
    }
    RayFrame drawn(float value) const {
        return drawn([=](glm::uvec2) { return glm::vec3(value); });
    }
    float middle_of(const HostImage& image) const { return *image.pixel(extent.x / 2, extent.y / 2); }
    HostImage any_colors() {
        HostImage colors(extent, 3);
        for (float& value : colors.values) value = uniform(random);
        return colors;
    }
    RayFrame drawn(const HostImage& colors) const {
        return drawn([&](glm::uvec2 pixel) { return colors.rgb(pixel.y * colors.extent.x + pixel.x); });
    }
};

/// Of the colours of all pixels.
struct Spread {
    double mean, variance;
};
inline Spread spread_of(const HostImage& image) {
    double sum = 0, squares = 0;
    for (size_t i = 0; i < image.pixel_count(); ++i)
        for (int c = 0; c < 3; ++c) sum += image.rgb(i)[c], squares += double(image.rgb(i)[c]) * image.rgb(i)[c];
    const double n = 3 * double(image.pixel_count());
    return {sum / n, squares / n - sum * sum / n / n};
}
