// Light samples of punctual lights that flat, smooth surfaces reflect.
#include "groundtruth/paths/traced_scene.h"
#include "tests/groundtruth/test_scene.h"

#include <gtest/gtest.h>
#include <cmath>
#include <random>

namespace {

const glm::vec3 looked_at(0, 0.6f, 0), lamp_at(1.5f, 1, 0.3f);

/// A wall at x = 0, and a floor before it.
TestScene wall_over(const Material& floor, const Material& wall = lambert_material(0.5f)) {
    TestScene scene;
    scene.quad({0, 0, 1}, {0, 0, -1}, {0, 2, -1}, {0, 2, 1}, scene.add(wall));
    scene.quad({0, 0, 3}, {6, 0, 3}, {6, 0, -3}, {0, 0, -3}, scene.add(floor));
    return scene;
}

/// Of the wall at `looked_at`.
PixelMoments render_wall(const TestScene& scene, unsigned samples, const PathTracerSettings& settings) {
    return render(scene, looking_along(looked_at + glm::vec3(0.1f, 0, 0), {-1, 0, 0}), samples, settings);
}

double schlick(double f0, double cosine) { return f0 + (1 - f0) * std::pow(1 - cosine, 5); }

/// Irradiance of the wall at `looked_at` from a lamp of 1 W/sr at a place.
double from_point(glm::dvec3 place) {
    const glm::dvec3 to_lamp = place - glm::dvec3(looked_at);
    return to_lamp.x / std::pow(glm::length(to_lamp), 3);
}

uint32_t images(const TestScene& scene) {
    return TracedScene(scene.scene, scene.pose(), CameraView({}, {1, 1}), {}).lights.mirrored_lamps().count();
}

}  // namespace

TEST(MirroredLamps, LightAWallAsTheirMirrorImagesWould) {
    const double f0 = 0.6, per_irradiance = 0.5 / M_PI;
    const glm::dvec3 image(lamp_at.x, -lamp_at.y, lamp_at.z), to_image = image - glm::dvec3(looked_at);
    const double by_mirror = schlick(f0, -to_image.y / glm::length(to_image)) * from_point(image);
    const glm::vec3 mirrored_at = looked_at + glm::vec3(to_image) * (looked_at.y / (looked_at.y + lamp_at.y));
    const glm::dvec3 sun = glm::normalize(glm::dvec3(-0.8, -1, 0.3));
    const PunctualLight point{.intensity = glm::vec3(3), .position = lamp_at};
    PunctualLight spot = point;  // which lights the floor where the wall's point sees it, and not that point
    spot.type = LightType::spot;
    spot.direction = glm::normalize(mirrored_at - lamp_at);
    spot.inner_cone_cos = 0.99f, spot.outer_cone_cos = 0.98f;
    const struct {
        PunctualLight lamp;
        double direct, mirrored;
    } cases[] = {
        {point, 3 * from_point(lamp_at), 3 * by_mirror},
        {spot, 0, 3 * by_mirror},
        {{.type = LightType::directional, .intensity = glm::vec3(2), .direction = sun},
         2 * -sun.x,
         2 * -sun.x * schlick(f0, -sun.y)},
    };
    for (const auto& expected : cases) {
        SCOPED_TRACE(int(expected.lamp.type));
        TestScene scene = wall_over(metal_material(float(f0), 0.0f));
        scene.scene.lights = {expected.lamp};
        ASSERT_EQ(images(scene), 1u);
        const Moments both = render_wall(scene, 256, {.max_depth = 2}).diffuse;
        const double exact = per_irradiance * (expected.direct + expected.mirrored);
        // Student's t with 15 degrees of freedom: 6 standard errors have p = 2.4e-5. 1e-3: the narrowest lobe has an
        // alpha of 1e-3, over which the cosines and distances are averaged.
        EXPECT_NEAR(both.mean.x, exact, 6 * both.standard_error.x + 1e-3 * exact);
        EXPECT_LT(both.standard_error.x, 3e-3 * exact);
        // One reflection less leaves the lamp itself. 1e-6: some ten roundings of float32.
        const Moments direct = render_wall(scene, 64, {.max_depth = 1}).diffuse;
        EXPECT_NEAR(direct.mean.x, per_irradiance * expected.direct, 6 * direct.standard_error.x + 1e-6);
    }
}

TEST(MirroredLamps, LeaveToLobesWhatOtherSurfacesReflect) {
    // Just above the mirror lies a plate that is too rough for one.
    TestScene scene = wall_over(metal_material(0.6f, 0.1f));
    scene.quad({0, 0.01f, 3}, {6, 0.01f, 3}, {6, 0.01f, -3}, {0, 0.01f, -3}, scene.add(metal_material(0.6f, 0.35f)));
    scene.scene.lights = {{.intensity = glm::vec3(3), .position = lamp_at}};
    ASSERT_EQ(images(scene), 1u);
    Moments of[2];
    for (const bool mirrored : {false, true})
        of[mirrored] =
            render_wall(scene, 1 << 14, {.max_depth = 2, .learns_lights = false, .mirrored_lamps = mirrored}).diffuse;
    // 30 degrees of freedom: 6 joint standard errors have p = 1.4e-6. The plate brings 18 % of the light.
    const double error = std::hypot(of[0].standard_error.x, of[1].standard_error.x);
    EXPECT_NEAR(of[1].mean.x, of[0].mean.x, 6 * error);
    EXPECT_LT(error, 0.005 * of[0].mean.x);
}

TEST(MirroredLamps, AreNoLitColor) {
    TestScene scene = wall_over(metal_material(0.6f, 0.0f), metal_material(0.7f, 0.4f));
    scene.scene.lights = {{.intensity = glm::vec3(3), .position = lamp_at}};
    ASSERT_EQ(images(scene), 1u);
    const PixelMoments pixel =
        render(scene, looking_along({1, 1.6f, 0.2f}, looked_at - glm::vec3(1, 1.6f, 0.2f)), 64, {.ladder = true});
    EXPECT_GT(pixel.incident.mean.x, 0.01);  // by the floor alone: neither metal has a lit colour
    EXPECT_EQ(pixel.camera_radiance.mean.x, 0.0);
    EXPECT_EQ(pixel.on_screen.mean.x, 0.0);
}

TEST(MirroredLamps, AreDrawnWithTheDensityThatTheyState) {
    TestScene scene = wall_over(metal_material(0.5f, 0.2f));
    scene.scene.lights = {{.intensity = glm::vec3(1), .position = lamp_at},
                          {.type = LightType::directional, .intensity = glm::vec3(1), .direction = {-0.6f, -0.8f, 0}}};
    const TracedScene traced(scene.scene, scene.pose(), CameraView({}, {1, 1}), {});
    const MirroredLamps& lamps = traced.lights.mirrored_lamps();
    ASSERT_EQ(lamps.count(), 2u);
    const glm::vec3 point(0.5f, 0.7f, -0.4f);
    const int rings = 5, sectors = 4, samples = 1 << 17, steps = 200;
    for (uint32_t image = 0; image < lamps.count(); ++image) {
        const glm::vec3 middle = lamps.sample(image, point, {0, 0}).direction;  // slope 0
        const glm::mat3 world_from_local = basis_from_normal(middle);
        const double edges[rings + 1] = {0, 0.02, 0.05, 0.1, 0.3, 0.6};  // rad; alpha is 0.04
        std::mt19937 random(5);
        std::uniform_real_distribution<float> uniform(0.0f, std::nextafter(1.0f, 0.0f));
        int found[rings][sectors] = {};
        for (int i = 0; i < samples; ++i) {
            const float u = uniform(random), v = uniform(random);
            const glm::vec3 local = lamps.sample(image, point, {u, v}).direction * world_from_local;
            const double angle = std::atan2(std::hypot(local.x, local.y), local.z);
            const double turn = std::atan2(local.y, local.x) / (2 * M_PI) + 0.5;
            for (int ring = 0; ring < rings; ++ring)
                if (angle >= edges[ring] && angle < edges[ring + 1])
                    ++found[ring][std::min(int(turn * sectors), sectors - 1)];
        }
        for (int ring = 0; ring < rings; ++ring)
            for (int sector = 0; sector < sectors; ++sector) {
                double expected = 0;
                const double width = (edges[ring + 1] - edges[ring]) / steps, arc = 2 * M_PI / sectors / steps;
                for (int i = 0; i < steps * steps; ++i) {
                    const double angle = edges[ring] + (i / steps + 0.5) * width;
                    const double turn = -M_PI + (sector * steps + i % steps + 0.5) * arc;
                    const glm::vec3 local(std::sin(angle) * std::cos(turn), std::sin(angle) * std::sin(turn),
                                          std::cos(angle));
                    expected +=
                        double(lamps.pdf(image, point, world_from_local * local)) * std::sin(angle) * width * arc;
                }
                // 40 counts: 5 standard deviations have p = 6e-7 each. 0.2 %: float32 near the middle, and the sum.
                EXPECT_NEAR(found[ring][sector], samples * expected,
                            5 * std::sqrt(samples * expected) + 2e-3 * samples * expected)
                    << image << ", " << ring << ", " << sector;
                EXPECT_GT(samples * expected, 50);
            }
    }
}

/// A room with two mirrors, a curved surface, and lamps of three kinds and colours.
TEST(MirroredLamps, ChangeNoMean) {
    TestScene room = wall_over(metal_material(0.7f, 0.2f));
    Material tile = metal_material(0.9f, 0.2f), paint = metal_material(0.5f, 0.4f);
    tile.metalness = paint.metalness = 0.0f;
    room.quad({0, 0, -1}, {6, 0, -1}, {6, 3, -1}, {0, 3, -1}, room.add(tile));
    room.sphere({1.2f, 0.4f, -0.3f}, 0.4f, 16, room.add(paint));
    room.scene.lights = {
        {.intensity = {60, 20, 20}, .position = {3, 4, 1}},
        {.type = LightType::directional, .intensity = {1, 2, 1}, .direction = {-0.6f, -0.8f, -0.2f}},
        {.type = LightType::spot,
         .intensity = {20, 20, 80},
         .inner_cone_cos = 0.9f,
         .outer_cone_cos = 0.6f,
         .position = {1.6f, 5, 0.5f},
         .direction = {0, -1, 0}},
    };
    ASSERT_EQ(images(room), 6u);
    CameraPose camera = looking_along({3.5f, 1.2f, 1.5f}, {-1, -0.25f, -0.55f});
    camera.is_orthographic = false;
    camera.vertical_fov = 0.7f;
    const glm::uvec2 extent(6, 4);
    const auto sums = [&](const PathTracerSettings& settings, unsigned samples, uint64_t seed, bool expects) {
        PathTracer tracer(room.scene, room.pose(), camera, extent, settings);
        if (expects) tracer.expect(HostImage(extent, 3, 0.05f), HostImage(extent, 3, 0.05f));
        std::array<Moments, 5> sum{};
        for (unsigned i = 0; i < extent.x * extent.y; ++i) {
            const PixelMoments pixel = render_pixel(tracer, i % extent.x, i / extent.x, samples, seed);
            EXPECT_EQ(pixel.non_finite, 0u);
            const Moments* parts[] = {&pixel.diffuse, &pixel.specular, &pixel.incident, &pixel.camera_radiance,
                                      &pixel.on_screen};
            for (size_t k = 0; k < sum.size(); ++k) {
                sum[k].mean += parts[k]->mean;
                sum[k].standard_error += parts[k]->standard_error * parts[k]->standard_error;  // squares
            }
        }
        return sum;
    };
    const auto without = sums({.learns_lights = false, .mirrored_lamps = false, .ladder = true}, 4096, 1, false);
    const struct {
        PathTracerSettings settings;
        bool expects;
    } cases[] = {{{.ladder = true}, false},
                 {{.strategy = LightStrategy::balance, .ladder = true}, false},
                 {{.learns_lights = false, .ladder = true}, false},
                 {{.ladder = true}, true}};
    for (const auto& [settings, expects] : cases) {
        const auto with = sums(settings, 1024, 2, expects);
        for (size_t k = 0; k < with.size(); ++k)
            for (int c = 0; c < 3; ++c) {
                const double error = std::sqrt(with[k].standard_error[c] + without[k].standard_error[c]);
                // 60 comparisons of sums over 24 pixels: 5 standard errors have p = 1.6e-4 if one pixel's 15 degrees of
                // freedom have all noise, so 1 % of all choices of seeds would fail a correct tracer; seeds are fixed.
                EXPECT_NEAR(with[k].mean[c], without[k].mean[c], 5 * error) << k << ", " << c;
                EXPECT_LT(error, 0.03 * without[k].mean[c]) << k << ", " << c;  // else this proves little
            }
    }
}

TEST(MirroredLamps, NeedAFlatSmoothSurfaceWithTheLampBeforeIt) {
    const auto images_of = [](const Material& floor, glm::vec3 position = lamp_at) {
        TestScene scene = wall_over(floor);
        scene.scene.lights = {{.intensity = glm::vec3(1), .position = position}};
        return images(scene);
    };
    const glm::vec3 below(1, -1, 0);
    Material mirror = metal_material(0.5f, 0.1f), two_sided = mirror, unlit = mirror, bumpy = mirror;
    two_sided.is_double_sided = unlit.is_unlit = true;
    bumpy.normal_texture.texture = 0;
    EXPECT_EQ(images_of(mirror), 1u);
    EXPECT_EQ(images_of(mirror, below), 0u);
    EXPECT_EQ(images_of(two_sided, below), 1u);
    EXPECT_EQ(images_of(metal_material(0.5f, 0.5f)), 0u);
    EXPECT_EQ(images_of(unlit), 0u);
    TestScene many = wall_over(mirror);
    many.scene.lights.assign(40, {.intensity = glm::vec3(1), .position = lamp_at});
    EXPECT_EQ(images(many), 16u);
    TestScene scene = wall_over(bumpy);
    scene.scene.textures.push_back({.name = "bumps", .extent = {1, 1}, .rgba = make_texels({128, 128, 255, 255})});
    scene.scene.lights = {{.intensity = glm::vec3(1), .position = lamp_at}};
    EXPECT_EQ(images(scene), 0u);
    scene.sphere({1, 1, -1}, 0.5f, 16, scene.add(mirror));
    EXPECT_EQ(images(scene), 0u);  // facets share the normals of their neighbours
}
