// What punctual lights send to the first hit is its highlight; what they send to anything else is light like any other.
#include "core/shared/brdf.h"
#include "tests/groundtruth/test_scene.h"

#include <gtest/gtest.h>
#include <cmath>

namespace {

const glm::dvec3 up(0, 1, 0);

void add_floor(TestScene& scene, const Material& material) {
    scene.quad({-9, 0, 9}, {9, 0, 9}, {9, 0, -9}, {-9, 0, -9}, scene.add(material));
}

/// F D V mu_i of a metal in double, from the formulas of glTF 2.0, appendix B. Unit vectors.
double metal_reflection(glm::dvec3 n, glm::dvec3 o, glm::dvec3 i, double f0, double roughness) {
    const double a = roughness * roughness, a2 = a * a;
    const glm::dvec3 m = glm::normalize(o + i);
    const double mu_m = glm::dot(n, m), mu_o = glm::dot(n, o), mu_i = glm::dot(n, i);
    const double d = a2 / (M_PI * std::pow(mu_m * mu_m * (a2 - 1) + 1, 2));
    const double root_o = std::sqrt(a2 + (1 - a2) * mu_o * mu_o), root_i = std::sqrt(a2 + (1 - a2) * mu_i * mu_i);
    const double v = 0.5 / (mu_o * root_i + mu_i * root_o);
    return (f0 + (1 - f0) * std::pow(1 - glm::dot(o, m), 5)) * d * v * mu_i;
}

/// A camera that sees the origin from `view` (unit).
CameraPose camera_at(glm::dvec3 view) { return looking_along(glm::vec3(view), glm::vec3(-view)); }

}  // namespace

TEST(highlight, is_the_closed_form_of_every_light_that_arrives) {
    const double f0 = 0.4, roughness = 0.6;
    TestScene scene;
    add_floor(scene, metal_material(float(f0), float(roughness)));
    scene.quad({-3, 1, -1}, {-1, 1, -1}, {-1, 1, 1}, {-3, 1, 1}, scene.add(lambert_material(0)));  // covers -x
    const glm::dvec3 view = glm::normalize(glm::dvec3(0.3, 1, 0.5)), point(1, 2, -1), spot(0, 3, 0.5);
    const glm::dvec3 sun = glm::normalize(glm::dvec3(-0.5, -1, 0.2));
    scene.scene.lights = {
        {.type = LightType::point, .intensity = {3, 6, 0}, .position = point},
        {.type = LightType::point, .intensity = glm::vec3(50), .position = {-4, 2, 0}},  // behind the cover
        {.type = LightType::point, .intensity = glm::vec3(50), .position = {0, -2, 0}},  // below the floor
        {.type = LightType::spot,
         .intensity = glm::vec3(2),
         .inner_cone_cos = 0.9f,
         .outer_cone_cos = 0.8f,
         .position = spot,
         .direction = {0, -1, 0}},
        {.type = LightType::directional, .intensity = glm::vec3(0.5f), .direction = sun},
    };
    const auto from_point = [&](glm::dvec3 light) {
        return metal_reflection(up, view, glm::normalize(light), f0, roughness) / glm::dot(light, light);
    };
    // The origin lies within the spot's inner cone: cos = 3 / sqrt(9.25) = 0.986.
    const double white = 2 * from_point(spot) + 0.5 * metal_reflection(up, view, -sun, f0, roughness);
    const PixelMoments pixel = render(scene, camera_at(view), 64);
    EXPECT_NEAR(pixel.hit.highlight.x, white + 3 * from_point(point), 1e-6);  // float32
    EXPECT_NEAR(pixel.hit.highlight.y, white + 6 * from_point(point), 1e-6);
    EXPECT_NEAR(pixel.hit.highlight.z, white, 1e-6);
    EXPECT_EQ(pixel.specular.mean, glm::dvec3(0.0));
    EXPECT_EQ(pixel.incident.mean, glm::dvec3(0.0));
}

TEST(highlight, of_what_is_reflected_is_part_of_the_reflection) {
    // A mirror floor under a glossy wall; the lobe (alpha = 0.001) meets the wall at (0, 2, -2).
    const double f0 = 0.7, roughness = 0.5;
    TestScene scene;
    add_floor(scene, metal_material(1, 0));
    scene.quad({-9, 0, -2}, {9, 0, -2}, {9, 9, -2}, {-9, 9, -2},
               scene.add(metal_material(float(f0), float(roughness))));
    const glm::dvec3 view = glm::normalize(glm::dvec3(0, 1, 1)), met(0, 2, -2), light(1, 3, 1);
    scene.scene.lights = {{.intensity = glm::vec3(10), .position = light}};
    const PixelMoments pixel = render(scene, camera_at(view), 256, {.ladder = true});
    const auto from = [&](glm::dvec3 place) {
        const glm::dvec3 to_light = place - met;
        return 10 * metal_reflection({0, 0, 1}, glm::normalize(-met), glm::normalize(to_light), f0, roughness) /
               glm::dot(to_light, to_light);
    };
    const double from_image = from({light.x, -light.y, light.z}), from_wall = from(light) + from_image;
    ASSERT_GT(from_wall, 0.05);
    ASSERT_GT(from_image, 0.01 * from_wall);
    // The floor shows the lamp to the wall as well. The lobe's tails widen what is seen of the wall.
    EXPECT_NEAR(pixel.incident.mean.x, from_wall, 2e-3 * from_wall);
    EXPECT_NEAR(pixel.specular.mean.x, from_wall, 2e-3 * from_wall);
    EXPECT_LT(pixel.hit.highlight.x, 1e-4);
    EXPECT_EQ(pixel.camera_radiance.mean.x, 0.0);  // a metal has no lit colour
}

TEST(highlight, leaves_diffuse_light_alone) {
    Material plastic = metal_material(0.5f, 0.3f);
    plastic.metalness = 0;
    TestScene scene;
    add_floor(scene, plastic);
    scene.scene.lights = {{.intensity = glm::vec3(10), .position = {0, 2, 0}}};
    const glm::dvec3 view = glm::normalize(glm::dvec3(1, 1, 0));
    const PixelMoments pixel = render(scene, camera_at(view), 16);
    const double o_m = std::cos(M_PI / 8), fresnel = 0.04 + 0.96 * std::pow(1 - o_m, 5);
    EXPECT_NEAR(pixel.diffuse.mean.x, 10.0 / 4 * 0.5 / M_PI * (1 - fresnel), 1e-6);
    EXPECT_GT(pixel.hit.highlight.x, 0);
}
