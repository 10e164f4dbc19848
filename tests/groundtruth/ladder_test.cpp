// The lower rungs of the truth ladder, pixel by pixel, in scenes where they are known.
#include "tests/groundtruth/test_scene.h"

#include <gtest/gtest.h>
#include <cmath>
#include <functional>

namespace {

// Without light samples a mirror's image of a lamp has no noise but for the far tails of its lobe (alpha = 0.001): a
// sample in 1e4 leaves by more than 0.2 rad.
const PathTracerSettings with_ladder{.strategy = LightStrategy::bsdf_only, .ladder = true};
const glm::vec3 eye(0, 2, 4);

/// A perspective camera at `eye` that looks at `target`.
CameraPose looking_at(glm::vec3 target, float vertical_fov) {
    CameraPose pose = looking_along(eye, target - eye);
    pose.is_orthographic = false;
    pose.vertical_fov = vertical_fov;
    return pose;
}

void add_floor(TestScene& scene, const Material& material) {
    scene.quad({-20, 0, 20}, {20, 0, 20}, {20, 0, -20}, {-20, 0, -20}, scene.add(material));
}

/// A wall at z = -4 that faces the camera; the floor at the origin mirrors its point (0, 2, -4).
void add_wall(TestScene& scene, const Material& material) {
    scene.quad({-3, 0, -4}, {3, 0, -4}, {3, 6, -4}, {-3, 6, -4}, scene.add(material));
}

/// Above the origin's mirror ray, facing down.
void add_underside(TestScene& scene, const Material& material, float height) {
    scene.quad({-9, height, -9}, {9, height, -9}, {9, height, 0}, {-9, height, 0}, scene.add(material));
}

PixelMoments render_origin(const TestScene& scene, unsigned samples, PathTracerSettings settings = with_ladder,
                           float fov = 2.0f) {
    return render(scene, looking_at({0, 0, 0}, fov), samples, settings);
}

/// 6 standard errors of 16 batches each are Student's t with some 30 degrees of freedom: p = 1.4e-6.
void expect_same(const Moments& a, const Moments& b, double tolerance) {
    for (int channel = 0; channel < 3; ++channel)
        EXPECT_NEAR(a.mean[channel], b.mean[channel],
                    6 * std::hypot(a.standard_error[channel], b.standard_error[channel]) + tolerance);
}

}  // namespace

TEST(ladder, rungs_are_equal_in_a_furnace) {
    // A mirror floor that loses nothing and a white Lambert sheet: everything radiates 1 in a sky of 1.
    TestScene scene;
    add_floor(scene, metal_material(1, 0));
    scene.quad({-1, .5f, -2}, {1, .5f, -2}, {1, 1.5f, -2.5f}, {-1, 1.5f, -2.5f}, scene.add(lambert_material(1)));
    scene.scene.environment.color = glm::vec3(1);
    for (const float roughness : {0.0f, 0.5f}) {
        scene.scene.materials[0].roughness = roughness;
        const bool is_lossless = roughness == 0;
        const PixelMoments pixel = render_origin(scene, 512);
        // The mirror's narrow lobe (alpha = 0.001) loses 1e-5 a bounce; a rough floor darkens what the sheet sees.
        if (is_lossless) {
            EXPECT_NEAR(pixel.incident.mean.x, 1, 1e-4);
            EXPECT_NEAR(pixel.camera_radiance.mean.x, 1, 1e-4);
            EXPECT_NEAR(pixel.on_screen.mean.x, 1, 1e-4);
        }
        // A Lambert sheet looks the same to the camera and to the floor, path by path.
        EXPECT_NEAR(pixel.camera_radiance.mean.x, pixel.incident.mean.x, 1e-6);
    }
}

TEST(ladder, sky_alone_is_the_same_on_every_rung) {
    TestScene scene;
    Material plastic = metal_material(0.5f, 0.7f);
    plastic.metalness = 0;
    add_floor(scene, plastic);
    scene.scene.environment.color = {1, 2, 3};
    const PixelMoments pixel = render_origin(scene, 64);
    for (const Moments* rung : {&pixel.incident, &pixel.camera_radiance, &pixel.on_screen})
        for (int channel = 0; channel < 3; ++channel) EXPECT_NEAR(rung->mean[channel], 1 + channel, 1e-6);
    EXPECT_EQ(pixel.hit.fallback, glm::vec3(1, 2, 3));
    EXPECT_GT(pixel.on_screen_share, 0.05);  // part of the lobe leaves through the upper half of the image
    EXPECT_LT(pixel.on_screen_share, 0.95);
}

TEST(ladder, all_on_screen_is_the_truth) {
    TestScene scene;
    add_floor(scene, metal_material(0.9f, 0));
    add_wall(scene, lambert_material(0.5f, 0.25f));
    scene.scene.lights.push_back({.intensity = glm::vec3(5), .position = {1, 3, -2}});
    const PixelMoments pixel = render_origin(scene, 512);
    EXPECT_EQ(pixel.on_screen_share, 1.0);
    EXPECT_GT(pixel.incident.mean.x, 0.3);
    // Nothing on the wall depends on the view, and both kinds of paths draw the same numbers: only float32 rounds
    // differently.
    EXPECT_NEAR(pixel.camera_radiance.mean.x, pixel.incident.mean.x, 1e-7);
    EXPECT_NEAR(pixel.on_screen.mean.x, pixel.incident.mean.x, 1e-7);
}

TEST(ladder, camera_radiance_is_the_lit_color_of_what_is_reflected) {
    // A dielectric wall, whose diffuse part depends on the view, under a lamp and a sky, next to a second reflector.
    TestScene scene;
    add_floor(scene, metal_material(0.8f, 0));
    Material paint = metal_material(0.6f, 0.4f);
    paint.metalness = 0;
    paint.base_color = {0.7f, 0.5f, 0.3f};
    add_wall(scene, paint);
    scene.quad({1, 5, -1}, {2, 5, -1}, {2, 5, -2}, {1, 5, -2}, scene.add(lambert_material(0, 20)));
    scene.quad({3, 0, -4}, {3, 0, 0}, {3, 4, 0}, {3, 4, -4}, scene.add(lambert_material(0.8f)));
    scene.scene.materials[2].is_double_sided = true;
    scene.scene.environment.color = glm::vec3(0.2f);
    const PixelMoments mirror = render_origin(scene, 8192);
    const PixelMoments wall = render(scene, looking_along(eye, glm::vec3(0, 2, -4) - eye), 8192);
    ASSERT_NEAR(wall.hit.position.z, -4, 1e-4);
    // The mirror's lobe (alpha = 0.001) spreads over centimetres of a wall whose light varies over metres.
    expect_same(mirror.camera_radiance, wall.diffuse, 2e-4);
    expect_same(mirror.on_screen, wall.diffuse, 2e-4);
    EXPECT_LT(mirror.camera_radiance.standard_error.x, 0.01 * wall.diffuse.mean.x);
    EXPECT_GT(mirror.incident.mean.x - mirror.camera_radiance.mean.x, 0.005);  // the wall's own gloss is not in it
}

TEST(ladder, reflections_of_reflections_are_lost) {
    TestScene scene;
    add_floor(scene, metal_material(1, 0));
    Material mirror = metal_material(0.8f, 0.2f);
    mirror.emission = {0.25f, 0.5f, 0};
    add_wall(scene, mirror);
    scene.scene.environment.color = glm::vec3(1);
    const PixelMoments pixel = render_origin(scene, 256);
    EXPECT_GT(pixel.incident.mean.x, 0.9);
    for (int channel = 0; channel < 3; ++channel)
        EXPECT_NEAR(pixel.camera_radiance.mean[channel], mirror.emission[channel],
                    1e-6);  // a metal has no lit colour of its own
}

TEST(ladder, what_the_screen_does_not_show_is_the_fallback) {
    struct Case {
        const char* name;
        double truth;
        bool is_shown;
        std::function<void(TestScene&)> build;
        float fov = 2.0f;
        float near = 0, far = 1e9f;  // m, along the axis: the origin is at 4.47
        bool draws_backs = true;
    };
    const Material bright = lambert_material(0, 5), dark = lambert_material(0);
    Material two_sided = bright;
    two_sided.is_double_sided = true;
    const Case cases[] = {
        {"a wall before the camera", 5, true, [&](TestScene& s) { add_wall(s, bright); }},
        {"an underside", 5, false, [&](TestScene& s) { add_underside(s, bright, 1); }},
        {"both sides shine, but the image shows the other one", 5, false,
         [&](TestScene& s) { add_underside(s, two_sided, 1); }},
        {"beyond the upper border", 5, false, [&](TestScene& s) { add_wall(s, bright); }, 0.3f},
        {"behind an obstacle", 5, false,
         [&](TestScene& s) {
             add_wall(s, bright);
             s.quad({-3, 1.4f, 1}, {3, 1.4f, 1}, {3, 2.6f, 1}, {-3, 2.6f, 1}, s.add(dark));
         }},
        {"sky beyond the upper border", 0.3, false, [](TestScene&) {}, 0.3f},
        {"behind an obstacle at 2.7 m, which near cuts away", 5, true,
         [&](TestScene& s) {
             add_wall(s, bright);
             s.quad({-3, 1.4f, 1}, {3, 1.4f, 1}, {3, 2.6f, 1}, {-3, 2.6f, 1}, s.add(dark));
         },
         2.0f, 3.5f},
        {"at 7.2 m, beyond far", 5, false, [&](TestScene& s) { add_wall(s, bright); }, 2.0f, 0, 6.0f},
        {"behind an obstacle whose front the eye sees, backs hidden", 5, false,
         [&](TestScene& s) {
             add_wall(s, bright);
             s.quad({-3, 1.4f, 1}, {3, 1.4f, 1}, {3, 2.6f, 1}, {-3, 2.6f, 1}, s.add(dark));
         },
         2.0f, 0, 1e9f, false},
        {"behind an obstacle whose hidden back faces the eye", 5, true,
         [&](TestScene& s) {
             add_wall(s, bright);
             s.quad({3, 1.4f, 1}, {-3, 1.4f, 1}, {-3, 2.6f, 1}, {3, 2.6f, 1}, s.add(dark));
         },
         2.0f, 0, 1e9f, false},
    };
    for (const Case& c : cases) {
        SCOPED_TRACE(c.name);
        TestScene scene;
        add_floor(scene, metal_material(1, 0));
        c.build(scene);
        scene.scene.environment.color = glm::vec3(0.3f);
        scene.scene.draws_backs = c.draws_backs;
        CameraPose camera = looking_at({0, 0, 0}, c.fov);
        camera.near = c.near, camera.far = c.far;
        const PixelMoments pixel = render(scene, camera, 64, with_ladder);
        EXPECT_NEAR(pixel.incident.mean.x, c.truth, 1e-5);
        EXPECT_NEAR(pixel.camera_radiance.mean.x, c.truth, 1e-5);
        EXPECT_NEAR(pixel.on_screen.mean.x, c.is_shown ? c.truth : 0.3, 1e-5);
        EXPECT_EQ(pixel.on_screen_share, c.is_shown ? 1.0 : 0.0);
    }
}

TEST(ladder, a_surface_that_faces_away_has_a_lit_color_of_its_own) {
    // The underside of a Lambert sheet in a sky: the camera is above it, and its own side would be black here.
    TestScene scene;
    add_floor(scene, metal_material(1, 0));
    add_underside(scene, lambert_material(0.6f), 1);
    scene.scene.lights.push_back({.intensity = glm::vec3(4), .position = {0, 0.5f, -1}});
    const PixelMoments pixel = render_origin(scene, 512);
    EXPECT_GT(pixel.incident.mean.x, 0.1);
    EXPECT_NEAR(pixel.camera_radiance.mean.x, pixel.incident.mean.x, 1e-7);  // float32 rounding
    EXPECT_EQ(pixel.on_screen.mean.x, 0.0);
}

TEST(ladder, a_rough_lobe_is_divided_between_screen_and_fallback) {
    // A lamp on the screen and one beside it; both are found by light samples and by the lobe. Where the second has the
    // radiance of the sky, the truth is what the first rung below it must be.
    const auto make = [](float beside) {
        TestScene scene;
        add_floor(scene, metal_material(1, 0.6f));
        scene.quad({-1, .5f, -2}, {1, .5f, -2}, {1, 1.5f, -2}, {-1, 1.5f, -2}, scene.add(lambert_material(0, 5)));
        scene.quad({4, 0, 1}, {4, 2, 1}, {4, 2, -1}, {4, 0, -1}, scene.add(lambert_material(0, beside)));
        scene.scene.materials.back().is_double_sided = true;
        scene.scene.environment.color = glm::vec3(0.3f);
        return scene;
    };
    const float fov = 0.9f;
    for (const LightStrategy strategy : {LightStrategy::power, LightStrategy::balance, LightStrategy::bsdf_only}) {
        const PixelMoments with_both = render_origin(make(12), 4096, {.strategy = strategy, .ladder = true}, fov);
        const PixelMoments with_one = render_origin(make(0.3f), 4096, {}, fov);
        EXPECT_GT(with_both.incident.mean.x, with_one.incident.mean.x + 0.05);
        expect_same(with_both.on_screen, with_one.incident, 1e-6);
        expect_same(with_both.camera_radiance, with_both.incident, 1e-6);  // lamps look the same from everywhere
        EXPECT_LT(with_both.on_screen.standard_error.x, 0.005);
    }
}

TEST(ladder, an_image_of_the_sky_is_on_screen_where_the_screen_shows_it) {
    TestScene scene;
    add_floor(scene, metal_material(1, 0));
    Environment& sky = scene.scene.environment;
    sky.type = Environment::Type::image;
    sky.latlong = HostImage({64, 32}, 3, 0.5f);
    for (unsigned y = 0; y < 16; ++y)
        for (unsigned x = 0; x < 64; ++x) sky.latlong.pixel(x, y)[0] = 0.5f + float(y) / 16;
    const PixelMoments seen = render_origin(scene, 1024), unseen = render_origin(scene, 1024, with_ladder, 0.3f);
    const glm::vec3 sky_there = sky.radiance(glm::normalize(glm::vec3(0, 2, -4)));
    EXPECT_NEAR(seen.on_screen_share, 1.0, 1e-3);
    EXPECT_NEAR(seen.on_screen.mean.x, sky_there.x, 2e-3);  // the lobe spreads over a tenth of a texel
    EXPECT_EQ(unseen.on_screen_share, 0.0);
    EXPECT_NEAR(unseen.on_screen.mean.x, unseen.hit.fallback.x, 1e-6);
    EXPECT_NEAR(unseen.hit.fallback.x, sky_there.x,
                0.02);  // at roughness 0 the fallback is the sky in the mirror direction
}

TEST(ladder, asking_for_it_changes_no_bit_of_the_truth) {
    TestScene scene;
    add_floor(scene, metal_material(0.9f, 0.4f));
    add_wall(scene, lambert_material(0.5f));
    scene.quad({1, 5, -1}, {2, 5, -1}, {2, 5, -2}, {1, 5, -2}, scene.add(lambert_material(0, 20)));
    scene.scene.environment.color = glm::vec3(0.2f);
    const PixelMoments with = render_origin(scene, 256, {.ladder = true}), without = render_origin(scene, 256, {});
    EXPECT_EQ(with.specular.mean, without.specular.mean);
    EXPECT_EQ(with.incident.mean, without.incident.mean);
    EXPECT_EQ(without.camera_radiance.mean, glm::dvec3(0.0));
    EXPECT_GT(with.camera_radiance.mean.x, 0.0);
}
