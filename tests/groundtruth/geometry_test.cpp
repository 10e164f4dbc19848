#include "groundtruth/paths/traced_scene.h"
#include "tests/groundtruth/test_scene.h"

#include <gtest/gtest.h>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <random>

// What rays meet: closed scenes do not leak, surfaces do not shadow themselves, masks cut, instances equal copies.

namespace {

const glm::vec3 up(0, 1, 0);

void add_floor(TestScene& scene, unsigned material, float half = 1.0f) {
    scene.quad({-half, 0, half}, {half, 0, half}, {half, 0, -half}, {-half, 0, -half}, material);
}

}  // namespace

/// A camera at the centre of a cube: every edge of the wall before it lies on a row or column of pixel centres of an
/// image of `edge_pixels` x `edge_pixels`, at 1/4 and 3/4 of it, and the edges that lead there on the diagonals.
constexpr unsigned edge_pixels = 70;
CameraPose camera_onto_edges(glm::vec3 center) {
    CameraPose pose = looking_along(center, {0, 0, -1});
    pose.is_orthographic = false;
    pose.vertical_fov = 2 * std::atan(2.0f);
    return pose;
}

std::vector<glm::uvec2> pixels_on_edges() {
    const unsigned first = edge_pixels / 4, last = edge_pixels - 1 - first;
    std::vector<glm::uvec2> pixels;
    for (unsigned i = first; i <= last; ++i)
        for (const unsigned side : {first, last}) pixels.push_back({i, side}), pixels.push_back({side, i});
    for (unsigned i = 0; i < edge_pixels; ++i)
        if (i < first || i > last) pixels.push_back({i, i}), pixels.push_back({i, edge_pixels - 1 - i});
    return pixels;
}

TEST(geometry, concave_edges_do_not_leak) {
    struct Place {
        glm::vec3 center;
        float half;
    };
    for (const Place& place : {Place{glm::vec3(0), 1},
                               {{0.3f, -0.7f, 0.1f}, 1},
                               {{10, 20, -30}, 1},
                               {glm::vec3(0), 1e-3f},
                               {glm::vec3(1), 1e-3f},
                               {glm::vec3(0), 1e4f},
                               {glm::vec3(1000), 1},
                               {{1e4f, 0, -1e4f}, 10}}) {
        TestScene glowing, dark;
        glowing.room(place.center - place.half, place.center + place.half, glowing.add(lambert_material(0.5f, 0.5f)));
        dark.room(place.center - place.half, place.center + place.half, dark.add(metal_material(0.9f, 0.5f)));
        dark.scene.environment.color = glm::vec3(1e6f);
        const CameraPose camera = camera_onto_edges(place.center);
        const PathTracer glow(glowing.scene, glowing.pose(), camera, glm::uvec2(edge_pixels), {});
        const PathTracer leak(dark.scene, dark.pose(), camera, glm::uvec2(edge_pixels), {});
        for (const glm::uvec2 pixel : pixels_on_edges()) {
            SCOPED_TRACE(testing::Message() << "centre " << place.center.x << ", half " << place.half << ", pixel "
                                            << pixel.x << ", " << pixel.y);
            const PixelMoments inside = render_pixel(glow, pixel.x, pixel.y, 16);
            const PixelMoments outside = render_pixel(leak, pixel.x, pixel.y, 16);
            ASSERT_TRUE(inside.hit.is_hit);
            // 0.5 / (1 - 0.5); 6 standard errors are exceeded with p = 2.4e-5, so by one of 1696 in 4 % of all choices
            // of seeds (these are fixed). A single lost sample of the first bounce is more than that.
            EXPECT_NEAR(inside.diffuse.mean.x, 1, 6 * inside.diffuse.standard_error.x + 1e-5);
            EXPECT_GT(inside.diffuse.mean.x, 0.9);
            EXPECT_EQ(outside.diffuse.mean.x + outside.specular.mean.x, 0.0);
        }
    }
}

TEST(geometry, closed_rooms_do_not_leak) {
    for (const float offset : {0.0f, 10.0f, 1000.0f}) {
        TestScene box, ball;
        for (TestScene* scene : {&box, &ball}) scene->scene.environment.color = glm::vec3(1e6f, 0, 0);
        box.room(glm::vec3(offset - 1), glm::vec3(offset + 1), box.add(metal_material(0.9f, 0.5f)));
        ball.sphere(glm::vec3(offset), 1.0f, 64, ball.add(lambert_material(0.9f)), true);
        for (const TestScene* scene : {&box, &ball})
            for (const glm::vec3 direction :
                 {glm::vec3(1, 0.2f, 0.1f), glm::vec3(0, -1, 0), glm::vec3(-0.3f, 0.5f, -0.8f)}) {
                const PixelMoments pixel = render(*scene, looking_along(glm::vec3(offset) + 0.1f, direction), 512);
                ASSERT_TRUE(pixel.hit.is_hit);
                EXPECT_EQ(pixel.diffuse.mean.x + pixel.specular.mean.x, 0.0) << "offset " << offset;
            }
    }
}

TEST(geometry, lamp_a_millimetre_above_a_surface_lights_it) {
    TestScene scene;
    add_floor(scene, scene.add(lambert_material(0.5f)));
    scene.quad({-.5f, 1e-3f, -.5f}, {.5f, 1e-3f, -.5f}, {.5f, 1e-3f, .5f}, {-.5f, 1e-3f, .5f},
               scene.add(lambert_material(0, 10)));
    const double exact = 5 * polygon_form_factor(glm::dvec3(0), up,
                                                 {{-.5, 1e-3, -.5}, {.5, 1e-3, -.5}, {.5, 1e-3, .5}, {-.5, 1e-3, .5}});
    // The camera looks from between the lamp and the floor.
    const PixelMoments pixel = render(scene, looking_along({0, 5e-4f, 0}, {0, -1, 0}), 1024);
    for (int channel = 0; channel < 3; ++channel)
        EXPECT_NEAR(pixel.diffuse.mean[channel], exact, 6 * pixel.diffuse.standard_error[channel] + 1e-5);
}

TEST(geometry, occluder_a_centimetre_before_a_distant_lamp_hides_it) {
    for (const float scale : {1e-3f, 1.0f, 100.0f}) {
        TestScene scene;
        add_floor(scene, scene.add(lambert_material(0.5f)), scale);
        const float lamp = 100 * scale, sheet = 99.99f * scale, half = 5 * scale;
        const unsigned light = scene.add(lambert_material(0, 1e4f)), black = scene.add(lambert_material(0));
        scene.quad({-half, lamp, -half}, {half, lamp, -half}, {half, lamp, half}, {-half, lamp, half}, light);
        scene.quad({-half, sheet, -half}, {half, sheet, -half}, {half, sheet, half}, {-half, sheet, half}, black);
        scene.scene.lights.push_back({.intensity = glm::vec3(1e4f), .position = {0, lamp, 0}});
        EXPECT_EQ(render(scene, looking_along({0, scale, 0}, {0, -1, 0}), 64).diffuse.mean, glm::dvec3(0.0));
    }
}

TEST(geometry, surface_that_a_punctual_light_lies_in_does_not_hide_it) {
    for (const float offset : {0.0f, 100.0f, 1e4f})
        for (const glm::vec3 place : {glm::vec3(0), glm::vec3(0.3f, 0, 0.7f), glm::vec3(3, 0, -4)}) {
            TestScene scene;
            const glm::vec3 at(offset, 0.3f * offset, -offset);
            const glm::vec3 light = at + glm::vec3(0, 2, 0) + place;
            scene.quad(at + glm::vec3(-5, 0, 5), at + glm::vec3(5, 0, 5), at + glm::vec3(5, 0, -5),
                       at + glm::vec3(-5, 0, -5), scene.add(lambert_material(0.5f)));
            const float y = light.y;
            scene.quad({at.x - 5, y, at.z - 5}, {at.x + 5, y, at.z - 5}, {at.x + 5, y, at.z + 5},
                       {at.x - 5, y, at.z + 5}, scene.add(lambert_material(0)));
            scene.scene.lights.push_back({.intensity = glm::vec3(1), .position = light});
            const PixelMoments pixel = render(scene, looking_along(at + glm::vec3(0, 1, 0), {0, -1, 0}), 16);
            const glm::dvec3 to_light = glm::dvec3(light) - glm::dvec3(pixel.hit.position);
            const double exact = 0.5 / M_PI * to_light.y / std::pow(glm::length(to_light), 3);
            // At 1e4 m positions are rounded to 1e-3 m, and the irradiance changes by 1.5 parts of a part of a way.
            EXPECT_NEAR(pixel.diffuse.mean.x, exact, exact * (1e-5 + 1e-7 * offset));
        }
}

/// Directions to and places on emitters of all shapes and scales, from points all around them: nothing is between, so
/// that every shadow ray must pass.
TEST(geometry, shadow_rays_do_not_meet_the_light_that_they_aim_at) {
    std::mt19937 random(1);
    const auto uniform = [&](float low, float high) { return std::uniform_real_distribution(low, high)(random); };
    const auto point = [&](float size) {
        return glm::vec3(uniform(-size, size), uniform(-size, size), uniform(-size, size));
    };
    for (const float size : {1e-3f, 1.0f, 100.0f, 1e4f})
        for (const float offset : {0.0f, 1.0f, 1e4f})
            for (const bool is_instanced : {false, true}) {
                if (size < 1e-5f * offset) continue;  // rounded to a point
                TestScene scene;
                Material lamp = lambert_material(0, 1);
                lamp.is_double_sided = true;
                Mesh mesh{.name = "shards", .material = scene.add(lamp)};
                const glm::vec3 center = point(offset), corner = point(size);
                const glm::vec3 edge = point(size), sliver = edge + point(0.01f * size), other = point(size);
                for (const glm::vec3 p : {corner, corner + edge, corner + (offset > 0 ? sliver : other)})
                    mesh.vertices.push_back({p, {0, 1, 0}, {1, 0, 0, 1}, {}, glm::vec4(1)});
                mesh.indices = {0, 1, 2};
                scene.mesh(std::move(mesh), glm::rotate(glm::translate(glm::mat4(1.0f), center), 1.0f, {.6f, .8f, 0}));
                if (is_instanced) scene.scene.instances.push_back(scene.scene.instances[0]);
                ScenePose pose = scene.pose();
                if (is_instanced)
                    pose.world_from_instance.push_back(
                        glm::translate(glm::mat4(1.0f), center + glm::vec3(1000 * size, 0, 0)));
                const CameraPose camera;
                const TracedScene traced(scene.scene, pose, CameraView(camera, {1, 1}), {});
                unsigned tested = 0, hidden = 0;
                for (int i = 0; i < 256; ++i) {
                    LanesVec3 from;
                    Lanes<uint32_t> x, y, is_wanted;
                    for (int lane = 0; lane < lane_count; ++lane) {
                        from.set(lane, center + point(i % 2 ? 2 * size : 50 * size));
                        x[lane] = uint32_t(random()), y[lane] = uint32_t(random()), is_wanted[lane] = 1;
                    }
                    LightLanes lights;
                    traced.lights.sample(is_wanted, from, {}, x, y, lights);
                    PixelEstimate cost;
                    for (int lane = 0; lane < lane_count; ++lane) {
                        const bool is_first = glm::length(lights.position.get(lane) - center) < 10 * size;
                        if (!(lights.pdf[lane] > 0) || !is_first) continue;  // the first may hide the second
                        aim_shadow_ray(from.get(lane), glm::vec3(0), glm::vec3(0), lane, lights);
                        ++tested;
                        hidden += !is_visible(traced, lights, lane, cost);
                    }
                }
                EXPECT_GT(tested, 1000u);
                EXPECT_EQ(hidden, 0u) << "size " << size << ", offset " << offset << ", instanced " << is_instanced;
            }
}

TEST(geometry, empty_scene_shows_the_environment) {
    TestScene scene;
    scene.scene.environment.color = {1, 2, 3};
    const PixelMoments pixel = render(scene, looking_along({0, 0, 0}, {0, 0, -1}), 16);
    EXPECT_FALSE(pixel.hit.is_hit);
    EXPECT_EQ(pixel.diffuse.mean, glm::dvec3(1, 2, 3));
    EXPECT_EQ(pixel.specular.mean, glm::dvec3(0.0));
}

TEST(geometry, unlit_surfaces_radiate_their_colour_and_light_others) {
    TestScene scene;
    Material glowing;
    glowing.base_color = {0.5f, 1.0f, 0.25f};
    glowing.is_unlit = true;
    add_floor(scene, scene.add(lambert_material(0.5f)));
    scene.quad({-.5f, 1, -.5f}, {.5f, 1, -.5f}, {.5f, 1, .5f}, {-.5f, 1, .5f}, scene.add(glowing));
    EXPECT_EQ(render(scene, looking_along({0, .5f, 0}, {0, 1, 0}), 16).diffuse.mean, glm::dvec3(0.5, 1.0, 0.25));
    const PixelMoments floor = render(scene, looking_along({0, .5f, 0}, {0, -1, 0}), 1024);
    EXPECT_NEAR(floor.diffuse.mean.y, 0.5 * 0.23945647046, 6 * floor.diffuse.standard_error.y + 1e-6);
}

TEST(geometry, alpha_mask_cuts_camera_rays_and_shadow_rays) {
    TestScene scene;
    Texture half{.name = "half",
                 .extent = {2, 1},
                 .rgba = make_texels({255, 255, 255, 255, 255, 255, 255, 0}),
                 .is_nearest = true};
    half.wrap_u = half.wrap_v = TextureWrap::clamp_to_edge;
    scene.scene.textures.push_back(half);
    Material mask = lambert_material(0.5f);
    mask.alpha_mode = AlphaMode::mask;
    mask.base_color_texture.texture = 0;
    add_floor(scene, scene.add(lambert_material(0.5f)));
    scene.quad({-1, 1, 1}, {1, 1, 1}, {1, 1, -1}, {-1, 1, -1}, scene.add(mask));  // opaque for x < 0
    scene.scene.lights.push_back(
        {.type = LightType::directional, .intensity = glm::vec3(2.0f), .direction = {0, -1, 0}});
    const PixelMoments covered = render(scene, looking_along({-.5f, 2, 0}, {0, -1, 0}), 16);
    const PixelMoments open = render(scene, looking_along({.5f, 2, 0}, {0, -1, 0}), 16);
    EXPECT_EQ(covered.hit.material, 1u);
    EXPECT_EQ(open.hit.material, 0u);
    const double lit = 2 * 0.5 / M_PI;
    EXPECT_NEAR(open.diffuse.mean.x, lit, 0.2 * lit);  // and a little that the sheet sends back
    const PixelMoments shadowed = render(scene, looking_along({-.5f, 0.5f, 0}, {0, -1, 0}), 256);
    EXPECT_LT(shadowed.diffuse.mean.x, 0.2 * lit);
    scene.scene.materials[1].alpha_cutoff = 0.0f;  // alpha >= cutoff counts as a hit: now all of it
    EXPECT_EQ(render(scene, looking_along({.5f, 2, 0}, {0, -1, 0}), 16).hit.material, 1u);
}

TEST(geometry, alpha_mask_cuts_lamps_for_every_light_strategy) {
    // Alpha falls from 1 to 0 between u = 1/4 and 3/4, so that the part of the lamp with alpha >= cutoff is a
    // rectangle.
    Texture ramp{.name = "ramp", .extent = {2, 1}, .rgba = make_texels({255, 255, 255, 255, 255, 255, 255, 0})};
    ramp.wrap_u = ramp.wrap_v = TextureWrap::clamp_to_edge;
    for (const bool is_seen_from_behind : {false, true})
        for (const float cutoff : {0.2f, 0.5f, 0.9f}) {
            TestScene scene;
            scene.scene.textures.push_back(ramp);
            Material lamp = lambert_material(0, 10);
            lamp.alpha_mode = AlphaMode::mask;
            lamp.alpha_cutoff = 0.9f * cutoff;
            lamp.alpha = 0.9f;
            lamp.base_color_texture.texture = 0;
            lamp.is_double_sided = is_seen_from_behind;
            add_floor(scene, scene.add(lambert_material(0.5f)));
            if (is_seen_from_behind)
                scene.quad({-.5f, 1, .5f}, {.5f, 1, .5f}, {.5f, 1, -.5f}, {-.5f, 1, -.5f}, scene.add(lamp));
            else
                scene.quad({-.5f, 1, -.5f}, {.5f, 1, -.5f}, {.5f, 1, .5f}, {-.5f, 1, .5f}, scene.add(lamp));
            const double edge = 0.25 - 0.5 * double(cutoff);
            const double exact = 5 * polygon_form_factor(glm::dvec3(0), up,
                                                         {{-.5, 1, -.5}, {edge, 1, -.5}, {edge, 1, .5}, {-.5, 1, .5}});
            for (const LightStrategy strategy :
                 {LightStrategy::power, LightStrategy::balance, LightStrategy::light_only, LightStrategy::bsdf_only}) {
                SCOPED_TRACE(testing::Message() << "cutoff " << cutoff << ", strategy " << int(strategy)
                                                << ", from behind " << is_seen_from_behind);
                const PixelMoments pixel = render(scene, looking_along({0, .5f, 0}, {0, -1, 0}), 1024,
                                                  {.strategy = strategy, .model = ReflectionModel::lambert});
                // 6 standard errors of 16 batches are exceeded with p = 2.4e-5, so by one of the 24 with 6e-4 over all
                // choices of seeds; 1e-5: the 8-bit ramp puts the edge in its place to float precision only.
                EXPECT_NEAR(pixel.diffuse.mean.x, exact, 6 * pixel.diffuse.standard_error.x + 1e-5);
                EXPECT_LT(pixel.diffuse.standard_error.x, 0.02 * exact);  // else the comparison proves little
            }
        }
}

TEST(geometry, emission_leaves_the_front_unless_double_sided) {
    for (const bool double_sided : {false, true})
        for (const bool mirrored : {false, true}) {
            TestScene scene;
            Material lamp = lambert_material(0, 1);
            lamp.is_double_sided = double_sided;
            add_floor(scene, scene.add(lamp));
            ScenePose pose = scene.pose();
            if (mirrored) pose.world_from_instance[0] = glm::scale(glm::mat4(1.0f), glm::vec3(-1, 1, 1));
            const PathTracer front(scene.scene, pose, looking_along({.1f, 1, .2f}, {0, -1, 0}), {1, 1}, {});
            const PathTracer back(scene.scene, pose, looking_along({.1f, -1, .2f}, {0, 1, 0}), {1, 1}, {});
            EXPECT_EQ(front.first_hit(0, 0).emitted, glm::vec3(1.0f));
            EXPECT_EQ(back.first_hit(0, 0).emitted, glm::vec3(double_sided ? 1.0f : 0.0f));
            EXPECT_NEAR(front.first_hit(0, 0).normal.y, 1, 1e-6);
            EXPECT_NEAR(back.first_hit(0, 0).normal.y, -1, 1e-6);
        }
}

/// glTF 2.0, section 3.9.5: no ray sees a single-sided surface from behind, so light reaches a floor through a card
/// whose back faces it, and none whose front does; drawn once (baked) or twice (an instance), mirrored or not.
TEST(geometry, light_passes_the_hidden_backs_of_single_sided_surfaces) {
    for (const bool is_instanced : {false, true})
        for (const bool is_mirrored : {false, true})
            for (const bool faces_floor : {false, true})
                for (const bool is_double_sided : {false, true})
                    for (const bool draws_backs : {false, true}) {
                        TestScene scene;
                        scene.scene.draws_backs = draws_backs;
                        add_floor(scene, scene.add(lambert_material(0.5f)));
                        scene.quad({-.5f, 2, -.5f}, {.5f, 2, -.5f}, {.5f, 2, .5f}, {-.5f, 2, .5f},
                                   scene.add(lambert_material(0, 10)));
                        const size_t card = scene.scene.meshes.size();
                        Material material = lambert_material(0.0f);
                        material.is_double_sided = is_double_sided;
                        add_floor(scene, scene.add(material), 3.0f);
                        std::swap(scene.scene.meshes[2].indices[1], scene.scene.meshes[2].indices[2]);
                        std::swap(scene.scene.meshes[2].indices[4], scene.scene.meshes[2].indices[5]);
                        if (is_instanced) scene.scene.instances.push_back({unsigned(card), 0});
                        ScenePose pose = scene.pose();
                        if (is_instanced) pose.world_from_instance.push_back(glm::mat4(1.0f));
                        for (size_t i = card; i < pose.world_from_instance.size(); ++i) {
                            glm::mat4& world = pose.world_from_instance[i];
                            world =
                                glm::translate(glm::mat4(1.0f), glm::vec3(0, 1 + 0.1f * float(i - card), 0)) * world;
                            // The card's own front is below. Half a turn about x brings it up.
                            if (!faces_floor) world = glm::rotate(world, float(M_PI), glm::vec3(1, 0, 0));
                            if (is_mirrored) world = glm::scale(world, glm::vec3(-1, 1, 1));
                        }
                        const PathTracer tracer(scene.scene, pose, looking_along({0, .5f, 0}, {0, -1, 0}), {1, 1},
                                                {.model = ReflectionModel::lambert});
                        const PixelMoments pixel = render_pixel(tracer, 0, 0, 64);
                        const double exact =
                            5 * polygon_form_factor(glm::dvec3(0), up,
                                                    {{-.5, 2, -.5}, {.5, 2, -.5}, {.5, 2, .5}, {-.5, 2, .5}});
                        const bool passes = !draws_backs && !is_double_sided && !faces_floor;
                        SCOPED_TRACE(testing::Message()
                                     << is_instanced << is_mirrored << faces_floor << is_double_sided << draws_backs);
                        // 6 standard errors of 16 batches are exceeded with p = 2.4e-5.
                        EXPECT_NEAR(pixel.diffuse.mean.x, passes ? exact : 0,
                                    6 * pixel.diffuse.standard_error.x + 1e-6);
                        EXPECT_LT(pixel.diffuse.standard_error.x, 0.05 * exact);
                    }
}

TEST(geometry, instances_may_be_flat) {
    // A ball twice, the second time flattened to a disk whose two sides, of two hemispheres, are both lit by the sky.
    TestScene scene;
    scene.scene.environment.color = glm::vec3(1.0f);
    scene.sphere(glm::vec3(0), 0.5f, 16, scene.add(lambert_material(0.6f)));
    scene.scene.instances.push_back({0, 0});
    ScenePose pose = scene.pose();
    pose.world_from_instance[0] = glm::translate(glm::mat4(1.0f), glm::vec3(5, 0, 0));
    pose.world_from_instance.push_back(glm::scale(glm::mat4(1.0f), glm::vec3(1, 0, 1)));
    for (const float side : {1.0f, -1.0f}) {
        const PathTracer tracer(scene.scene, pose, looking_along({.1f, side, .2f}, {0, -side, 0}), {1, 1}, {});
        const PixelMoments pixel = render_pixel(tracer, 0, 0, 64);
        EXPECT_EQ(pixel.hit.instance, 1u);
        EXPECT_EQ(pixel.hit.normal, glm::vec3(0, side, 0));
        EXPECT_EQ(pixel.hit.geometric_normal, glm::vec3(0, side, 0));
        // The ball at 5 m fills less than 1 % of the sky.
        EXPECT_NEAR(pixel.diffuse.mean.x, 0.6, 0.006);
    }
}

TEST(geometry, instances_equal_baked_copies) {
    // Two balls, one mirrored and stretched, as two instances of one mesh and as two meshes.
    TestScene one, two;
    for (TestScene* scene : {&one, &two}) {
        scene->scene.environment = {
            .type = Environment::Type::gradient, .color = glm::vec3(1), .slope = glm::vec3(0.5f)};
        add_floor(*scene, scene->add(lambert_material(0.6f)), 5);
        Material shiny = metal_material(0.7f, 0.4f);
        shiny.emission = {0.2f, 0, 0};
        scene->sphere(glm::vec3(0), 0.5f, 16, scene->add(shiny));
    }
    two.mesh(two.scene.meshes[1]);
    ScenePose pose = two.pose();
    pose.world_from_instance[1] = glm::translate(glm::mat4(1.0f), glm::vec3(-.7f, .6f, 0));
    pose.world_from_instance[2] = glm::rotate(
        glm::scale(glm::translate(glm::mat4(1.0f), glm::vec3(.7f, .8f, 0)), glm::vec3(-1, 1.5f, 1)), 0.3f, up);
    one.scene.instances.push_back({1, 0});
    CameraPose camera = looking_along({0, 1.5f, 4}, {0, -0.25f, -1});
    camera.is_orthographic = false;
    camera.vertical_fov = 0.7f;
    const PathTracer instanced(one.scene, pose, camera, {24, 16}, {}), baked(two.scene, pose, camera, {24, 16}, {});
    unsigned balls = 0;
    for (unsigned y = 0; y < 16; ++y)
        for (unsigned x = 0; x < 24; ++x) {
            const FirstHit a = instanced.first_hit(x, y), b = baked.first_hit(x, y);
            ASSERT_EQ(a.is_hit, b.is_hit);
            if (!a.is_hit) continue;
            EXPECT_EQ(a.material, b.material);
            EXPECT_EQ(a.instance, b.instance);
            EXPECT_NEAR(glm::length(a.position - b.position), 0, 1e-5);
            EXPECT_NEAR(glm::length(a.normal - b.normal), 0, 1e-4);
            EXPECT_EQ(a.emitted, b.emitted);
            if (a.material != 1) continue;
            ++balls;
            PixelEstimate c, d;
            instanced.trace(x, y, a, 1, 0, 128, c);
            baked.trace(x, y, b, 1, 0, 128, d);
            // The same paths but for rounding, which may flip a roulette decision or an edge now and then.
            EXPECT_NEAR(c.specular.x, d.specular.x, 0.03 * d.specular.x);
        }
    EXPECT_GT(balls, 30u);
}
