#include "core/shared/environment.h"
#include "tests/groundtruth/test_scene.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#include <array>
#include <cmath>

// Properties that hold for any scene: the mean does not depend on how it is estimated. z-tests allow 6 joint standard
// errors of 16 batches each (Student's t, about 30 degrees of freedom: p = 1.4e-6 a comparison, 500 comparisons: 0.07 %
// of all choices of seeds would fail a correct tracer; the seeds are fixed).

namespace {

/// An open room with a lamp, a spot, an image environment, metals and dielectrics, and a mask between lamp and floor.
TestScene make_room(float scale = 1.0f) {
    TestScene room;
    Material plastic = metal_material(0.6f, 0.6f), wall = lambert_material(0.5f), fence = lambert_material(0.4f);
    plastic.base_color = {0.2f, 0.5f, 0.7f};
    plastic.metalness = 0.0f;
    std::vector<uint8_t> rgba;
    for (int i = 0; i < 4; ++i) rgba.insert(rgba.end(), {255, 255, 255, uint8_t(i % 2 ? 0 : 255)});
    room.scene.textures.push_back(
        {.name = "stripes", .extent = {4, 1}, .rgba = make_texels(std::move(rgba)), .is_nearest = true});
    fence.alpha_mode = AlphaMode::mask;
    fence.base_color_texture.texture = 0;
    const unsigned floor = room.add(metal_material(0.8f, 0.7f)), painted = room.add(plastic), grey = room.add(wall),
                   mask = room.add(fence);
    const unsigned lamp = room.add(lambert_material(0.0f, 5.0f * scale));
    room.quad({-2, 0, 2}, {2, 0, 2}, {2, 0, -2}, {-2, 0, -2}, floor);
    room.quad({-2, 0, -2}, {2, 0, -2}, {2, 3, -2}, {-2, 3, -2}, grey);
    room.quad({-2, 0, 2}, {-2, 0, -2}, {-2, 3, -2}, {-2, 3, 2}, painted);
    room.quad({0.5f, 2.5f, -0.5f}, {1.5f, 2.5f, -0.5f}, {1.5f, 2.5f, 0.5f}, {0.5f, 2.5f, 0.5f}, lamp);
    room.quad({0, 1.5f, -1}, {2, 1.5f, -1}, {2, 1.5f, 1}, {0, 1.5f, 1}, mask);
    room.sphere({-0.7f, 0.6f, -0.5f}, 0.6f, 24, painted);
    room.scene.lights.push_back({.type = LightType::spot,
                                 .intensity = glm::vec3(2.0f * scale),
                                 .range = 20,
                                 .position = {-1, 2.5f, 1},
                                 .direction = {0, -1, 0}});
    Environment& sky = room.scene.environment;
    sky.type = Environment::Type::image;
    sky.latlong = HostImage({32, 16}, 3, 0.2f * scale);
    for (int channel = 0; channel < 3; ++channel) sky.latlong.pixel(20, 4)[channel] = 20.0f * scale;
    return room;
}

CameraPose room_camera() {
    CameraPose pose = looking_along({0.3f, 1.7f, 4.5f}, {-0.05f, -0.25f, -1});
    pose.is_orthographic = false;
    pose.vertical_fov = 0.8f;
    return pose;
}

constexpr glm::uvec2 extent(8, 8);
const glm::uvec2 pixels[] = {{1, 3}, {2, 6}, {3, 4}, {4, 2}, {5, 6}, {7, 7}};

struct Render {
    std::vector<PixelMoments> pixels;
};

Render render_room(const TestScene& room, const PathTracerSettings& settings, unsigned samples, uint64_t seed) {
    const PathTracer tracer(room.scene, room.pose(), room_camera(), extent, settings);
    Render result{std::vector<PixelMoments>(std::size(pixels))};
    tbb::parallel_for(size_t(0), std::size(pixels), [&](size_t i) {
        result.pixels[i] = render_pixel(tracer, pixels[i].x, pixels[i].y, samples, seed);
    });
    return result;
}

void expect_same_mean(const Moments& a, const Moments& b) {
    for (int channel = 0; channel < 3; ++channel) {
        const double error = std::hypot(a.standard_error[channel], b.standard_error[channel]);
        EXPECT_NEAR(a.mean[channel], b.mean[channel], 6 * error + 1e-9);
        EXPECT_LT(error, 0.1 * std::abs(b.mean[channel]) + 1e-3);  // else the comparison proves little
    }
}

/// Over pixels, which draw independent paths. Channels share theirs: red stands for all.
void expect_same_sum(const Render& a, const Render& b, Moments PixelMoments::*member) {
    double sum_a = 0, sum_b = 0, variance = 0;
    for (size_t i = 0; i < a.pixels.size(); ++i) {
        const Moments &one = a.pixels[i].*member, &other = b.pixels[i].*member;
        sum_a += one.mean.x, sum_b += other.mean.x;
        variance += std::pow(one.standard_error.x, 2) + std::pow(other.standard_error.x, 2);
    }
    EXPECT_NEAR(sum_a, sum_b, 5 * std::sqrt(variance));  // p = 1.6e-4 if one pixel's 15 degrees have all noise
    EXPECT_LE(std::sqrt(variance), 0.01 * sum_b);        // found: 0.0007 to 0.0022; else this proves little
}

void expect_same_means(const Render& a, const Render& b) {
    for (size_t i = 0; i < a.pixels.size(); ++i) {
        SCOPED_TRACE(i);
        EXPECT_EQ(a.pixels[i].non_finite + b.pixels[i].non_finite, 0u);
        expect_same_mean(a.pixels[i].diffuse, b.pixels[i].diffuse);
        expect_same_mean(a.pixels[i].specular, b.pixels[i].specular);
        expect_same_mean(a.pixels[i].incident, b.pixels[i].incident);
        expect_same_mean(a.pixels[i].camera_radiance, b.pixels[i].camera_radiance);
        expect_same_mean(a.pixels[i].on_screen, b.pixels[i].on_screen);
    }
    // One pixel admits a bias of a good part of its mean; a strategy that forgets a share of the light shows in their
    // sum.
    for (const auto member : {&PixelMoments::diffuse, &PixelMoments::specular, &PixelMoments::incident,
                              &PixelMoments::camera_radiance, &PixelMoments::on_screen})
        expect_same_sum(a, b, member);
}

PixelEstimate sums(const PathTracer& tracer, glm::uvec2 pixel, unsigned samples) {
    PixelEstimate estimate;
    tracer.trace(pixel.x, pixel.y, tracer.first_hit(pixel.x, pixel.y), 9, 0, samples, estimate);
    return estimate;
}

}  // namespace

TEST(estimator, mean_does_not_depend_on_the_light_strategy) {
    const TestScene room = make_room();
    const Render power = render_room(room, {.ladder = true}, 4096, 1);
    for (const LightStrategy strategy : {LightStrategy::balance, LightStrategy::light_only, LightStrategy::bsdf_only}) {
        SCOPED_TRACE(int(strategy));
        expect_same_means(render_room(room, {.strategy = strategy, .ladder = true}, 8192, 2), power);
    }
}

/// A sky of radiance `bright` towards +x and `dim` towards -x, as an image: unlike a constant it is sampled as a light.
Environment split_sky(float bright, float dim) {
    Environment sky{.type = Environment::Type::image, .latlong = HostImage({64, 32}, 3)};
    for (unsigned y = 0; y < 32; ++y)
        for (unsigned x = 0; x < 64; ++x) {
            const bool is_bright = environment_direction({(x + 0.5f) / 64, (y + 0.5f) / 32}, 0.0f).x > 0;
            sky.latlong.set_rgb(y * 64 + x, glm::vec3(is_bright ? bright : dim));
        }
    return sky;
}

TEST(estimator, lamp_in_a_bright_sky_has_its_closed_form_for_every_strategy) {
    TestScene scene;
    scene.quad({-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1}, scene.add(lambert_material(0.5f)));
    scene.quad({-.5f, 1, -.5f}, {.5f, 1, -.5f}, {.5f, 1, .5f}, {-.5f, 1, .5f}, scene.add(lambert_material(0, 10)));
    scene.scene.environment = split_sky(30, 2);
    scene.scene.lights.push_back({.intensity = glm::vec3(4), .position = {0, 0.5f, 0}});
    // The lamp hides as much of either half of the sky.
    const double lamp = 0.23945647046, exact = 0.5 * (10 * lamp + 16 * (1 - lamp)) + 0.5 / M_PI * 4 / 0.25;
    for (const LightStrategy strategy :
         {LightStrategy::power, LightStrategy::balance, LightStrategy::light_only, LightStrategy::bsdf_only}) {
        const PixelMoments pixel = render(scene, looking_along({0, .4f, 0}, {0, -1, 0}), 4096,
                                          {.strategy = strategy, .model = ReflectionModel::lambert});
        // Student's t with 15 degrees of freedom: 6 standard errors have p = 2.4e-5 each. 1e-4: the image is bilinear
        // and its poles are not, which moves the mean of a hemisphere by about as much.
        EXPECT_NEAR(pixel.diffuse.mean.x, exact, 6 * pixel.diffuse.standard_error.x + 1e-4 * exact);
        EXPECT_LT(pixel.diffuse.standard_error.x, 0.005 * exact);
    }
}

TEST(estimator, more_lights_than_groups_have_their_closed_form) {
    // Lamps of a ring and three near ones, which bring three quarters of the light: if each counted only as its part of
    // its group, much light would be missing.
    TestScene scene;
    scene.quad({-1, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-1, 0, -1}, scene.add(lambert_material(0.5f)));
    std::vector<PunctualLight>& lights = scene.scene.lights;
    const int in_ring = 70;
    for (int i = 0; i < in_ring; ++i) {
        const float turn = 2 * float(M_PI) * float(i) / in_ring;
        lights.push_back({.intensity = glm::vec3(0.2f), .position = {std::cos(turn), 2, std::sin(turn)}});
    }
    lights.push_back({.intensity = glm::vec3(0.5f), .position = {0.1f, 0.5f, 0}});
    lights.push_back({.intensity = glm::vec3(0.4f), .position = {0, 0.4f, 0.1f}});
    lights.push_back({.intensity = glm::vec3(0.3f), .position = {-0.1f, 0.3f, 0}});
    // Albedo / pi times intensity times cosine / distance^2.
    double exact = 0;
    for (const PunctualLight& light : lights)
        exact += 0.5 / M_PI * light.intensity.x * light.position.y / std::pow(glm::length(light.position), 3);
    const PixelMoments pixel =
        render(scene, looking_along({0, .6f, 0}, {0, -1, 0}), 256, {.model = ReflectionModel::lambert});
    // 6 standard errors with 15 degrees of freedom: p = 2.4e-5. 1e-4: probabilities and sums of float32, with room.
    EXPECT_NEAR(pixel.diffuse.mean.x, exact, 6 * pixel.diffuse.standard_error.x + 1e-4 * exact);
    EXPECT_LT(pixel.diffuse.standard_error.x, 0.02 * exact);
}

TEST(estimator, sky_that_is_not_seen_starves_no_lamp) {
    // A closed room, lit by a lamp and a bulb: the sky outside has nearly all the power, and nothing to say.
    TestScene room;
    room.room({-1, 0, -1}, {1, 2, 1}, room.add(lambert_material(0.5f)));
    room.quad({-.3f, 1.99f, -.3f}, {.3f, 1.99f, -.3f}, {.3f, 1.99f, .3f}, {-.3f, 1.99f, .3f},
              room.add(lambert_material(0, 5)));
    room.scene.lights.push_back({.intensity = glm::vec3(0.1f), .position = {.5f, 1.5f, .5f}});
    TestScene outside = room;
    outside.scene.environment = split_sky(200, 1);
    CameraPose camera = looking_along({.2f, 1.2f, .9f}, {-.2f, -.4f, -1});
    camera.is_orthographic = false;
    camera.vertical_fov = 1.2f;
    const glm::uvec2 size(8, 8);
    const PathTracer without(room.scene, room.pose(), camera, size, {}),
        with(outside.scene, outside.pose(), camera, size, {});
    double mean[2] = {}, variance[2] = {};
    for (unsigned i = 0; i < size.x * size.y; ++i)
        for (const bool has_sky : {false, true}) {
            const PixelMoments pixel = render_pixel(has_sky ? with : without, i % size.x, i / size.x, 64);
            mean[has_sky] += pixel.diffuse.mean.y;
            variance[has_sky] += std::pow(pixel.diffuse.standard_error.y, 2);
        }
    // By power alone the lamps would get 1 % of the light samples, and 100 times the variance of their share; learnt,
    // the sky keeps a third of the even share. Batches estimate the sums of 64 variances to some 5 %.
    EXPECT_LT(variance[1], 1.5 * variance[0]);
    EXPECT_NEAR(mean[1], mean[0], 6 * std::sqrt(variance[0] + variance[1]));
}

TEST(estimator, small_window_under_a_wide_sky_has_its_closed_form_and_its_samples) {
    // A black box over a grey floor, with a window of 0.4 m in a wall 3 m from the point that is seen: 0.2 % of the
    // sky, all of which is as bright above the horizon.
    TestScene scene;
    const unsigned grey = scene.add(lambert_material(0.5f)), black = scene.add(lambert_material(0));
    scene.quad({-3, 0, 3}, {3, 0, 3}, {3, 0, -3}, {-3, 0, -3}, grey);
    scene.quad({-3, 2, -3}, {3, 2, -3}, {3, 2, 3}, {-3, 2, 3}, black);
    const auto wall = [&](float y0, float y1, float z0, float z1) {
        scene.quad({3, y0, z0}, {3, y0, z1}, {3, y1, z1}, {3, y1, z0}, black);
    };
    wall(0, 2, -3, .5f), wall(0, 2, .9f, 3), wall(0, .8f, .5f, .9f), wall(1.2f, 2, .5f, .9f);
    scene.quad({-3, 0, 3}, {-3, 0, -3}, {-3, 2, -3}, {-3, 2, 3}, black);
    for (const float z : {-3.0f, 3.0f}) scene.quad({-3, 0, z}, {3, 0, z}, {3, 2, z}, {-3, 2, z}, black);
    Environment& sky = scene.scene.environment;
    sky = {.type = Environment::Type::image, .latlong = HostImage({64, 32}, 3)};
    for (unsigned i = 0; i < 64 * 16; ++i) sky.latlong.set_rgb(i, glm::vec3(10));
    const double exact =
        0.5 * 10 * polygon_form_factor({0, 0, 0}, {0, 1, 0}, {{3, .8, .5}, {3, .8, .9}, {3, 1.2, .9}, {3, 1.2, .5}});
    const PixelMoments pixel =
        render(scene, looking_along({0, 1, 0}, {0, -1, 0}), 256, {.model = ReflectionModel::lambert});
    // 6 standard errors with 15 degrees of freedom: p = 2.4e-5.
    EXPECT_NEAR(pixel.diffuse.mean.x, exact, 6 * pixel.diffuse.standard_error.x);
    EXPECT_LT(pixel.diffuse.standard_error.x, 0.08 * exact);  // 0.023; with the sky in one piece 0.24
}

TEST(estimator, lamp_of_a_room_is_sampled_in_that_room) {
    // Sixteen rooms in a row, black but for the floor, with a lamp each: fifteen of them are hidden where the camera
    // is. A batch has fewer samples than there are rooms.
    TestScene scene;
    const unsigned grey = scene.add(lambert_material(0.5f)), black = scene.add(lambert_material(0)),
                   lamp = scene.add(lambert_material(0, 5));
    const int rooms = 16;
    for (int i = 0; i < rooms; ++i) {
        const float x = 3 * float(i);
        scene.room({x - 1.4f, 0, -1.4f}, {x + 1.4f, 2, 1.4f}, black);
        scene.quad({x - 1.4f, .01f, 1.4f}, {x + 1.4f, .01f, 1.4f}, {x + 1.4f, .01f, -1.4f}, {x - 1.4f, .01f, -1.4f},
                   grey);
        scene.quad({x - .1f, 1.8f, -.1f}, {x + .1f, 1.8f, -.1f}, {x + .1f, 1.8f, .1f}, {x - .1f, 1.8f, .1f}, lamp);
    }
    for (const int seen : {0, 7}) {
        const double x = 3.0 * seen;
        const double exact =
            0.5 * 5 *
            polygon_form_factor({x + 0.5, .01, 0}, {0, 1, 0},
                                {{x - .1, 1.8, -.1}, {x + .1, 1.8, -.1}, {x + .1, 1.8, .1}, {x - .1, 1.8, .1}});
        const PixelMoments pixel =
            render(scene, looking_along({float(x) + 0.5f, 1, 0}, {0, -1, 0}), 4, {.model = ReflectionModel::lambert});
        // 6 standard errors with 15 degrees of freedom: p = 2.4e-5 each.
        EXPECT_NEAR(pixel.diffuse.mean.x, exact, 6 * pixel.diffuse.standard_error.x + 1e-4 * exact);
        EXPECT_LT(pixel.diffuse.standard_error.x, 0.15 * exact);  // 0.05; with all lamps in one group 0.4
    }
}

TEST(estimator, mean_does_not_depend_on_roulette_or_seed) {
    const TestScene room = make_room();
    const Render usual = render_room(room, {}, 4096, 3);
    expect_same_means(render_room(room, {.russian_roulette = false}, 2048, 4), usual);
    expect_same_means(render_room(room, {}, 4096, 5), usual);
}

/// The first hit and those after it are estimated by code of their own: here of a dielectric, whose samples are divided
/// between two lobes, under a sky that varies. A mirror of 2 cm, 10 m above it, shows what the camera sees directly; of
/// the light it takes 4e-6.
TEST(estimator, surface_looks_the_same_in_a_mirror) {
    const glm::vec3 sky_axis = glm::normalize(glm::vec3(-0.5f, 0.6f, 0.4f));
    for (const LightStrategy strategy : {LightStrategy::bsdf_only, LightStrategy::power})
        for (const float cosine : {0.3f, 0.8f}) {
            SCOPED_TRACE(testing::Message() << "cosine " << cosine << ", strategy " << int(strategy));
            const float sine = std::sqrt(1 - cosine * cosine);
            TestScene scene;
            Material plastic = metal_material(0.6f, 0.5f);
            plastic.metalness = 0.0f;
            scene.quad({-100, 0, 100}, {100, 0, 100}, {100, 0, -100}, {-100, 0, -100}, scene.add(plastic));
            scene.quad({-0.01f, 10, -0.01f}, {0.01f, 10, -0.01f}, {0.01f, 10, 0.01f}, {-0.01f, 10, 0.01f},
                       scene.add(metal_material(1, 0)));
            scene.scene.environment = {
                .type = Environment::Type::gradient, .color = glm::vec3(1), .slope = glm::vec3(0.8f), .axis = sky_axis};
            const PathTracerSettings settings{.strategy = strategy};
            const PixelMoments seen = render(scene, looking_along({20, 1, 0}, {-sine, -cosine, 0}), 8192, settings);
            const PixelMoments mirrored =
                render(scene, looking_along({sine, 10 - cosine, 0}, {-sine, cosine, 0}), 8192, settings);
            for (int c = 0; c < 3; ++c) {
                const double direct = seen.diffuse.mean[c] + seen.specular.mean[c];
                const double error =
                    glm::length(glm::dvec3(seen.diffuse.standard_error[c], seen.specular.standard_error[c],
                                           mirrored.incident.standard_error[c]));
                // The mirror's lobe, alpha 0.001, blurs by a milliradian or two, over which what it shows changes by as
                // much: its radiance of about 1 has a slope of about 1 per radian. Noise beyond that would prove
                // little.
                EXPECT_NEAR(mirrored.incident.mean[c], direct, 6 * error + 2e-3 * direct);
                EXPECT_LT(error, 2e-3 * direct);
            }
        }
}

TEST(estimator, roulette_by_what_is_expected_changes_no_mean) {
    const TestScene room = make_room();
    const PathTracer usual(room.scene, room.pose(), room_camera(), extent, {});
    PathTracer expecting(room.scene, room.pose(), room_camera(), extent, {});
    // Pixels of this room hold 0.02 to 1: most are expected to be brighter than they are, some darker.
    expecting.expect(HostImage(extent, 3, 0.5f), HostImage(extent, 3, 0.5f));
    Render a{std::vector<PixelMoments>(std::size(pixels))}, b = a;
    uint64_t rays = 0, usual_rays = 0;
    for (size_t i = 0; i < std::size(pixels); ++i) {
        a.pixels[i] = render_pixel(usual, pixels[i].x, pixels[i].y, 2048, 10);
        b.pixels[i] = render_pixel(expecting, pixels[i].x, pixels[i].y, 4096, 11);
        usual_rays += sums(usual, pixels[i], 256).rays, rays += sums(expecting, pixels[i], 256).rays;
    }
    expect_same_means(b, a);
    EXPECT_LT(rays, 0.9 * double(usual_rays));  // it decides
}

TEST(estimator, roulette_of_shadow_rays_changes_no_mean) {
    const TestScene room = make_room();
    Render renders[2] = {{std::vector<PixelMoments>(std::size(pixels))},
                         {std::vector<PixelMoments>(std::size(pixels))}};
    uint64_t rays[2] = {};
    for (const bool plays : {false, true}) {
        PathTracer tracer(room.scene, room.pose(), room_camera(), extent,
                          {.splitting = false, .shadow_roulette = plays, .ladder = true});
        // Pixels of this room hold 0.02 to 1: most are expected to be brighter, so that most light samples play.
        tracer.expect(HostImage(extent, 3, 0.5f), HostImage(extent, 3, 0.5f));
        for (size_t i = 0; i < std::size(pixels); ++i) {
            renders[plays].pixels[i] = render_pixel(tracer, pixels[i].x, pixels[i].y, 8192, plays);
            rays[plays] += sums(tracer, pixels[i], 256).rays;
        }
    }
    expect_same_means(renders[1], renders[0]);
    EXPECT_LT(double(rays[1]), 0.8 * double(rays[0]));  // it decides
}

TEST(estimator, splitting_changes_no_mean) {
    const TestScene room = make_room();
    Render renders[2] = {{std::vector<PixelMoments>(std::size(pixels))},
                         {std::vector<PixelMoments>(std::size(pixels))}};
    uint64_t rays[2] = {};
    for (const bool splits : {false, true}) {
        PathTracer tracer(room.scene, room.pose(), room_camera(), extent, {.splitting = splits});
        // Pixels of this room hold 0.02 to 1: nearly all paths promise several times what their pixel is said to hold.
        tracer.expect(HostImage(extent, 3, 0.01f), HostImage(extent, 3, 0.01f));
        for (size_t i = 0; i < std::size(pixels); ++i) {
            renders[splits].pixels[i] = render_pixel(tracer, pixels[i].x, pixels[i].y, 4096, splits);
            rays[splits] += sums(tracer, pixels[i], 256).rays;
        }
    }
    expect_same_means(renders[1], renders[0]);
    EXPECT_GT(double(rays[1]), 1.3 * double(rays[0]));  // it decides
}

/// A mirror that shows a grey floor, from which paths find a bright or a dim half of the sky by chance: what varies is
/// the direction from the floor, which splitting draws several times.
TEST(estimator, splitting_takes_the_variance_of_what_a_mirror_shows) {
    TestScene scene;
    scene.quad({-100, 0, 100}, {100, 0, 100}, {100, 0, -100}, {-100, 0, -100}, scene.add(lambert_material(0.5f)));
    scene.quad({-0.01f, 10, -0.01f}, {0.01f, 10, -0.01f}, {0.01f, 10, 0.01f}, {-0.01f, 10, 0.01f},
               scene.add(metal_material(1, 0)));
    scene.scene.environment = split_sky(30, 2);
    double variance[2] = {}, mean[2] = {};
    const unsigned seeds = 64;
    for (const bool splits : {false, true}) {
        PathTracer tracer(scene.scene, scene.pose(), looking_along({0.6f, 10 - 0.8f, 0}, {-0.6f, 0.8f, 0}), {1, 1},
                          {.strategy = LightStrategy::bsdf_only, .splitting = splits});
        // An eighth of what the mirror holds: each path is worth eight of its pixels, and is split into four.
        tracer.expect(HostImage({1, 1}, 3, 1.0f), HostImage({1, 1}, 3, 1.0f));
        for (unsigned seed = 0; seed < seeds; ++seed) {  // of one sample a batch, which nothing stratifies
            const Moments incident = render_pixel(tracer, 0, 0, 1, seed).incident;
            mean[splits] += incident.mean.x / seeds;
            variance[splits] += std::pow(incident.standard_error.x / seeds, 2);
        }
        // Half of the mean of both halves of the sky. 6 standard errors of 960 degrees of freedom: p = 3e-9.
        EXPECT_NEAR(mean[splits], 8, 6 * std::sqrt(variance[splits]));
    }
    // Each variance of 1024 paths, which find either of two values, is known to some 3 %.
    EXPECT_NEAR(variance[1] / variance[0], 1.0 / 4, 0.05);
}

TEST(estimator, translation_changes_nothing) {
    const TestScene room = make_room();
    TestScene moved = room;
    const glm::vec3 offset(1000, -1000, 1000);
    for (Mesh& mesh : moved.scene.meshes)
        for (Vertex& vertex : mesh.vertices) vertex.position += offset;
    for (PunctualLight& light : moved.scene.lights) light.position += offset;
    CameraPose camera = room_camera();
    camera.world_from_view[3] += glm::vec4(offset, 0);
    const Render here = render_room(room, {}, 4096, 6);
    const PathTracer tracer(moved.scene, moved.pose(), camera, extent, {});
    Render there{std::vector<PixelMoments>(std::size(pixels))};
    for (size_t i = 0; i < std::size(pixels); ++i)
        there.pixels[i] = render_pixel(tracer, pixels[i].x, pixels[i].y, 4096, 7);
    expect_same_means(there, here);
}

TEST(estimator, scaling_all_light_by_1024_scales_every_bit) {
    const TestScene dim = make_room(), bright = make_room(1024);
    const PathTracer a(dim.scene, dim.pose(), room_camera(), extent, {}),
        b(bright.scene, bright.pose(), room_camera(), extent, {});
    for (const glm::uvec2 pixel : pixels) {
        const PixelEstimate x = sums(a, pixel, 256), y = sums(b, pixel, 256);
        EXPECT_EQ(x.diffuse * 1024.0, y.diffuse);
        EXPECT_EQ(x.specular * 1024.0, y.specular);
        EXPECT_EQ(x.incident * 1024.0, y.incident);
        EXPECT_GT(x.specular.x + x.diffuse.x, 0);
    }
}

TEST(estimator, leaving_out_changes_no_bit) {
    TestScene plain;  // needs nothing: no mask, texture, lamp, environment image, specular lobe
    plain.room({-1, -1, -1}, {1, 1, 5}, plain.add(lambert_material(0.5f, 0.1f)));
    plain.scene.materials[0].emission = glm::vec3(0.0f);
    plain.scene.environment.color = glm::vec3(1.0f);
    plain.scene.meshes.erase(plain.scene.meshes.begin());
    plain.scene.instances.erase(plain.scene.instances.begin());
    for (unsigned i = 0; i < plain.scene.instances.size(); ++i) plain.scene.instances[i].mesh = i;
    ScenePose pose = plain.pose();
    pose.world_from_instance.pop_back();
    const CameraPose camera = looking_along({0.1f, 0.2f, 3}, {0.1f, 0.2f, -1});
    const PathTracer lean(plain.scene, pose, camera, {1, 1}, {}),
        full(plain.scene, pose, camera, {1, 1}, {.keep_all = true});
    EXPECT_EQ(lean.left_out().size(), 6u);
    EXPECT_TRUE(full.left_out().empty());
    const PixelEstimate a = sums(lean, {0, 0}, 512), b = sums(full, {0, 0}, 512);
    EXPECT_GT(a.diffuse.x, 0);
    EXPECT_EQ(a.diffuse, b.diffuse);
    EXPECT_EQ(a.specular, b.specular);
    EXPECT_EQ(a.incident, b.incident);

    const TestScene room = make_room();
    const PathTracer lean_room(room.scene, room.pose(), room_camera(), extent, {}),
        full_room(room.scene, room.pose(), room_camera(), extent, {.keep_all = true});
    ASSERT_EQ(lean_room.left_out().size(), 1u);
    EXPECT_EQ(lean_room.left_out().front().what, "back-face tests");  // it draws backs
    for (const glm::uvec2 pixel : pixels)
        EXPECT_EQ(sums(lean_room, pixel, 64).diffuse, sums(full_room, pixel, 64).diffuse);
}

TEST(estimator, splitting_samples_changes_only_rounding) {
    const TestScene room = make_room();
    const PathTracer tracer(room.scene, room.pose(), room_camera(), extent, {});
    for (const glm::uvec2 pixel : pixels) {
        const PixelEstimate whole = sums(tracer, pixel, 192);
        PixelEstimate parts;
        const FirstHit hit = tracer.first_hit(pixel.x, pixel.y);
        for (const auto& [first, count] : {std::pair(0u, 5u), {5u, 59u}, {64u, 128u}})
            tracer.trace(pixel.x, pixel.y, hit, 9, first, count, parts);
        EXPECT_EQ(whole.samples, parts.samples);
        EXPECT_EQ(whole.lobe_samples, parts.lobe_samples);
        EXPECT_EQ(whole.rays, parts.rays);
        // Each path is the same to the bit; the order in which their sums are added is not.
        for (int channel = 0; channel < 3; ++channel) {
            EXPECT_NEAR(whole.diffuse[channel], parts.diffuse[channel], 1e-12 * whole.diffuse[channel]);
            EXPECT_NEAR(whole.specular[channel], parts.specular[channel], 1e-12 * whole.specular[channel]);
            EXPECT_NEAR(whole.incident[channel], parts.incident[channel], 1e-12 * whole.incident[channel]);
        }
    }
}

TEST(estimator, batches_traced_together_are_those_traced_alone) {
    // Of fifteen batches, so that the last lanes stay free: of one sample, of five, and of as many as there are lanes.
    const TestScene room = make_room();
    PathTracer tracer(room.scene, room.pose(), room_camera(), extent, {.ladder = true});
    HostImage bright(extent, 3, 0.5f), dark(extent, 3, 1e-3f);  // paths of dark pixels are split
    tracer.expect(dark, bright);
    for (const unsigned count : {1u, 5u, 16u})
        for (const glm::uvec2 pixel : pixels) {
            const FirstHit hit = tracer.first_hit(pixel.x, pixel.y);
            std::array<SampleBatch, 15> together;
            for (unsigned b = 0; b < together.size(); ++b) together[b].seed = 70 + b;
            tracer.trace(pixel.x, pixel.y, hit, 32, count, together);
            for (const auto& [seed, all] : together) {
                PixelEstimate alone;
                tracer.trace(pixel.x, pixel.y, hit, seed, 32, count, alone);
                EXPECT_EQ(all.samples, alone.samples);
                EXPECT_EQ(all.lobe_samples, alone.lobe_samples);
                EXPECT_EQ(all.on_screen_samples, alone.on_screen_samples);
                EXPECT_EQ(all.rays, alone.rays);
                EXPECT_EQ(all.paths, alone.paths);
                // Each path is the same to the bit; the order in which their sums are added is not.
                for (const auto output :
                     {&PixelEstimate::diffuse, &PixelEstimate::specular, &PixelEstimate::incident,
                      &PixelEstimate::camera_radiance, &PixelEstimate::on_screen, &PixelEstimate::cut})
                    for (int channel = 0; channel < 3; ++channel)
                        EXPECT_NEAR((all.*output)[channel], (alone.*output)[channel], 1e-12 * (alone.*output)[channel]);
            }
        }
}

/// n samples of k directions are the samples of k n indices, weighed by 1 / k. That is a power of two, so that nothing
/// is rounded but sums; and roulette, by what is expected here, decides as it does without.
TEST(estimator, directions_of_a_sample_are_those_of_as_many_samples) {
    const TestScene room = make_room();
    PathTracer tracer(room.scene, room.pose(), room_camera(), extent, {.ladder = true});
    tracer.expect(HostImage(extent, 3, 0.2f), HostImage(extent, 3, 0.2f));
    for (const unsigned k : {2u, 16u})
        for (const glm::uvec2 pixel : pixels) {
            const FirstHit hit = tracer.first_hit(pixel.x, pixel.y);
            SampleBatch one{.seed = 9, .estimate = {}}, many = one;
            tracer.trace(pixel.x, pixel.y, hit, 32, 48, {&one, 1}, {k, k});
            tracer.trace(pixel.x, pixel.y, hit, 32 * k, 48 * k, {&many, 1});
            EXPECT_EQ(one.estimate.samples * k, many.estimate.samples);
            EXPECT_EQ(one.estimate.lobe_samples, many.estimate.lobe_samples);
            EXPECT_EQ(one.estimate.on_screen_samples, many.estimate.on_screen_samples);
            EXPECT_EQ(one.estimate.rays, many.estimate.rays);
            for (const auto& [output, share] : {std::pair(&PixelEstimate::diffuse, 1.0 / k),
                                                {&PixelEstimate::specular, 1.0 / k},
                                                {&PixelEstimate::cut, 1.0 / k},
                                                {&PixelEstimate::incident, 1.0},
                                                {&PixelEstimate::camera_radiance, 1.0},
                                                {&PixelEstimate::on_screen, 1.0}})
                for (int channel = 0; channel < 3; ++channel)
                    EXPECT_NEAR((one.estimate.*output)[channel], share * (many.estimate.*output)[channel],
                                1e-12 * share * (many.estimate.*output)[channel]);
        }
}

TEST(estimator, directions_of_a_lobe_change_no_mean_and_no_other_output) {
    const TestScene room = make_room();
    PathTracer tracer(room.scene, room.pose(), room_camera(), extent, {.ladder = true});
    tracer.expect(HostImage(extent, 3, 0.2f), HostImage(extent, 3, 0.2f));
    Render one{std::vector<PixelMoments>(std::size(pixels))}, more_diffuse = one, more_specular = one;
    for (size_t i = 0; i < std::size(pixels); ++i) {
        const auto [x, y] = std::pair(pixels[i].x, pixels[i].y);
        one.pixels[i] = render_pixel(tracer, x, y, 4096, 1);
        more_diffuse.pixels[i] = render_pixel(tracer, x, y, 1024, 2, {8, 4});
        more_specular.pixels[i] = render_pixel(tracer, x, y, 1024, 3, {4, 8});
        const FirstHit hit = tracer.first_hit(x, y);
        SampleBatch of_both{.seed = 9, .estimate = {}}, alone = of_both;
        tracer.trace(x, y, hit, 0, 64, {&of_both, 1}, {8, 1});
        tracer.trace(x, y, hit, 0, 64, {&alone, 1}, {0, 1});
        EXPECT_EQ(alone.estimate.diffuse, glm::dvec3(0.0));
        for (int channel = 0; channel < 3; ++channel)
            EXPECT_NEAR(of_both.estimate.specular[channel], alone.estimate.specular[channel],
                        1e-12 * alone.estimate.specular[channel]);
    }
    expect_same_means(more_diffuse, one);
    expect_same_means(more_specular, one);
}

TEST(estimator, number_of_threads_changes_no_bit) {
    const TestScene room = make_room();
    const PathTracer tracer(room.scene, room.pose(), room_camera(), extent, {});
    std::vector<PixelEstimate> images[2];
    for (const int threads : {1, 4}) {
        std::vector<PixelEstimate>& image = images[threads > 1];
        image.resize(extent.x * extent.y);
        tbb::task_arena(threads).execute([&] {
            tbb::parallel_for(0u, extent.x * extent.y, [&](unsigned i) {
                image[i] = sums(tracer, {i % extent.x, i / extent.x}, 32);
            });
        });
    }
    for (size_t i = 0; i < images[0].size(); ++i) {
        EXPECT_EQ(images[0][i].diffuse, images[1][i].diffuse);
        EXPECT_EQ(images[0][i].specular, images[1][i].specular);
        EXPECT_EQ(images[0][i].rays, images[1][i].rays);
    }
}

TEST(estimator, independent_seeds_differ_as_their_errors_say) {
    const TestScene room = make_room();
    const PathTracer tracer(room.scene, room.pose(), room_camera(), {16, 16}, {});
    std::vector<double> z(256, 0.0);
    tbb::parallel_for(0u, 256u, [&](unsigned i) {
        const PixelMoments a = render_pixel(tracer, i % 16, i / 16, 128, 20),
                           b = render_pixel(tracer, i % 16, i / 16, 128, 21);
        const double error = std::hypot(a.diffuse.standard_error.y, b.diffuse.standard_error.y);
        if (error > 0) z[i] = (a.diffuse.mean.y - b.diffuse.mean.y) / error;
    });
    double squares = 0, products = 0, count = 0;
    for (unsigned i = 0; i < 256; ++i) {
        squares += z[i] * z[i];
        if (i % 16) products += z[i] * z[i - 1];
        count += z[i] != 0;
    }
    ASSERT_GT(count, 100);
    // z^2 has mean 30/28 and standard deviation 1.6 if batch means are normal: 5 deviations of the mean (p = 6e-7).
    EXPECT_NEAR(squares / count, 30.0 / 28, 5 * 1.6 / std::sqrt(count));
    EXPECT_NEAR(products / squares, 0, 5 / std::sqrt(count));  // neighbours share no random numbers
}
