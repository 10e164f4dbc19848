#include "core/error.h"
#include "core/gbuffer/gbuffer_transfer.h"
#include "core/scene/load_scene.h"
#include "core/shared/brdf.h"
#include "tests/gbuffer/test_scenes.h"

#include <gtest/gtest.h>
#include <functional>
#include <glm/gtc/matrix_transform.hpp>

namespace {

HostGBuffer render(const Scene& scene, const SceneCamera& camera, const FrameView& view, RasterizerOptions options = {},
                   bool is_lit = false) {
    options.extent = view.extent;
    Rasterizer rasterizer(test_device(), scene, options);
    const GBuffer gbuffer = rasterizer.render(camera, view);
    if (is_lit) rasterizer.light_directly(gbuffer);
    return download_gbuffer(rasterizer.pass_list(), gbuffer, rasterizer.camera(), options.depth_format);
}

size_t differing_bits(const HostGBuffer& a, const HostGBuffer& b) {
    size_t count = 0;
    for (const auto image :
         {&HostGBuffer::depth, &HostGBuffer::geometric_normal, &HostGBuffer::normal, &HostGBuffer::base_color,
          &HostGBuffer::emission, &HostGBuffer::motion, &HostGBuffer::material_id, &HostGBuffer::previous_depth,
          &HostGBuffer::previous_normal, &HostGBuffer::lit})
        count += ::differing_bits(a.*image, b.*image);
    return count;
}

glm::dvec2 project(const glm::mat4& clip_from_world, glm::dvec3 p) {
    const glm::dvec4 clip = glm::dmat4(clip_from_world) * glm::dvec4(p, 1);
    return glm::dvec2(clip) / clip.w * 0.5 + 0.5;
}

glm::dvec3 world_position(const HostGBuffer& g, unsigned x, unsigned y) {
    const glm::dvec2 uv = (glm::dvec2(x, y) + 0.5 + glm::dvec2(glm::vec2(g.camera.jitter))) / glm::dvec2(g.extent());
    const glm::dvec4 view =
        glm::inverse(glm::dmat4(g.camera.clip_from_view)) * glm::dvec4(uv * 2.0 - 1.0, *g.depth.pixel(x, y), 1);
    return glm::dvec3(glm::dmat4(g.camera.world_from_view) * (view / view.w));
}

/// `deformed`: what instance 1 is moved by beside its transform, at a pose.
void expect_motion_of(const Scene& scene, const std::function<glm::dmat4(const ScenePose&)>& deformed) {
    FrameView view = view_of({200, 151}, 8, DepthDirection::reversed);
    view.jitter = {0.3f, -0.2f};
    const HostGBuffer g = render(scene, scene.camera("main"), view);
    const ScenePose now = pose_scene(scene, 8), before = pose_scene(scene, 7);
    const auto place = [&](const ScenePose& pose) { return glm::dmat4(pose.world_from_instance[1]) * deformed(pose); };
    // The moving quad is alone in using its material, so its id shows where the pixel's surface was.
    const glm::dmat4 moved = place(before) * glm::inverse(place(now));
    size_t moving = 0, background = 0;
    for (unsigned y = 0; y < g.extent().y; ++y)
        for (unsigned x = 0; x < g.extent().x; ++x) {
            const glm::vec2 uv = (glm::vec2(x, y) + 0.5f + view.jitter) / glm::vec2(view.extent);
            glm::dvec2 expected;
            if (*g.material_id.pixel(x, y) == 0) {
                const glm::dvec3 eye(glm::dvec4(g.camera.world_from_view[3]));
                const glm::dvec4 vs =
                    glm::inverse(glm::dmat4(g.camera.clip_from_view)) * glm::dvec4(glm::dvec2(uv) * 2.0 - 1.0, 0.5, 1);
                const glm::dvec3 direction =
                    glm::dmat3(g.camera.world_from_view) * glm::normalize(glm::dvec3(vs) / vs.w);
                expected = glm::dvec2(uv) - project(g.camera.previous_clip_from_world, eye + 1e9 * direction);
                ++background;
            } else {
                const glm::dvec3 p = world_position(g, x, y);
                const bool moves = *g.material_id.pixel(x, y) == 2;
                moving += moves;
                expected = glm::dvec2(uv) -
                           project(g.camera.previous_clip_from_world, moves ? glm::dvec3(moved * glm::dvec4(p, 1)) : p);
            }
            // 1/50 of a pixel: vertices are snapped to 1/256 of one, and depth has 24 bits.
            ASSERT_NEAR(g.motion.pixel(x, y)[0] * view.extent.x, expected.x * view.extent.x, 0.02) << x << ", " << y;
            ASSERT_NEAR(g.motion.pixel(x, y)[1] * view.extent.y, expected.y * view.extent.y, 0.02) << x << ", " << y;
        }
    EXPECT_GT(moving, 100u);
    EXPECT_GT(background, 100u);
}

}  // namespace

TEST(motion, is_what_two_projections_in_double_precision_give) {
    expect_motion_of(varied_scene(), [](const ScenePose&) { return glm::dmat4(1); });
}

/// Every vertex follows the joints alike, and the morph target moves all alike, which makes an affine map of both.
TEST(motion, of_joints_and_morph_targets_is_theirs) {
    Scene scene = deforming_scene();
    scene.instances.erase(scene.instances.begin() + 3);  // what bends
    const Mesh& mesh = scene.meshes[scene.instances[1].mesh];
    expect_motion_of(scene, [&](const ScenePose& pose) {
        const Deformation& deformation = pose.deformations[1];
        const glm::dmat4 joints =
            0.25 * glm::dmat4(deformation.instance_from_mesh[0]) + 0.75 * glm::dmat4(deformation.instance_from_mesh[1]);
        return joints *
               glm::translate(glm::dmat4(1), double(deformation.weights[0]) * glm::dvec3(mesh.targets[0].positions[0]));
    });
}

TEST(rasterizer, deformed_frames_in_a_row_are_those_drawn_alone) {
    const Scene scene = deforming_scene();
    const SceneCamera& camera = scene.camera("orthographic");
    const glm::uvec2 extent{91, 77};
    Rasterizer rasterizer(test_device(), scene, {.extent = extent});
    struct Step {
        unsigned frame, previous;
    };
    for (const Step step : {Step{4, 3}, {5, 4}, {6, 5}, {6, 6}, {12, 6}, {7, 6}}) {  // also held, and jumping
        FrameView view = view_of(extent, step.frame);
        view.index = step.frame, view.previous_frame = step.previous;
        const GBuffer gbuffer = rasterizer.render(camera, view);
        const HostGBuffer in_a_row =
            download_gbuffer(rasterizer.pass_list(), gbuffer, rasterizer.camera(), DepthFormat::d32f);
        EXPECT_EQ(differing_bits(in_a_row, render(scene, camera, view)), 0u) << step.frame;
    }
}

TEST(motion, is_zero_where_nothing_moves) {
    Scene scene = varied_scene();
    scene.animation.clear();
    const HostGBuffer g = render(scene, scene.camera("orthographic"), view_of({65, 33}, 4));
    for (const float value : g.motion.values) ASSERT_EQ(value, 0.0f);
}

TEST(rasterizer, jitter_moves_the_samples_and_not_the_matrices) {
    const Scene scene = varied_scene();
    const HostGBuffer plain = render(scene, scene.camera("main"), view_of({128, 96}));
    FrameView view = view_of({128, 96});
    view.jitter = {1, 2};  // whole pixels: pixel (x, y) must see what (x + 1, y + 2) saw
    const HostGBuffer jittered = render(scene, scene.camera("main"), view);
    EXPECT_EQ(plain.camera.clip_from_world, jittered.camera.clip_from_world);
    size_t different = 0;
    for (unsigned y = 0; y < 94; ++y)
        for (unsigned x = 0; x < 127; ++x)
            different += *jittered.material_id.pixel(x, y) != *plain.material_id.pixel(x + 1, y + 2);
    EXPECT_LT(different, 25u) << "of 12000; snapping may turn single pixels of an edge";
}

TEST(rasterizer, previous_images_are_those_of_the_frame_before) {
    const Scene scene = varied_scene();
    const SceneCamera& camera = scene.camera("main");
    const FrameView before = view_of({91, 77}, 4), now = view_of({91, 77}, 5);
    const HostGBuffer alone = render(scene, camera, before);
    const HostGBuffer jumped = render(scene, camera, now);  // draws frame 4 by itself
    EXPECT_EQ(::differing_bits(jumped.previous_depth, alone.depth), 0u);
    EXPECT_EQ(::differing_bits(jumped.previous_normal, alone.normal), 0u);
    EXPECT_NE(::differing_bits(jumped.depth, alone.depth), 0u);

    Rasterizer rasterizer(test_device(), scene, {.extent = {91, 77}});
    rasterizer.render(camera, before);
    const GBuffer g = rasterizer.render(camera, now);
    EXPECT_EQ(
        differing_bits(download_gbuffer(rasterizer.pass_list(), g, rasterizer.camera(), DepthFormat::d32f), jumped),
        0u);

    const HostGBuffer first = render(scene, camera, view_of({91, 77}, 0));
    EXPECT_EQ(::differing_bits(first.previous_depth, first.depth), 0u);
    EXPECT_EQ(::differing_bits(first.previous_normal, first.normal), 0u);
}

TEST(rasterizer, leaving_out_changes_no_bit) {
    Scene scene = varied_scene();
    const SceneCamera camera = scene.camera("main");
    EXPECT_EQ(differing_bits(render(scene, camera, view_of({99, 55}, 2), {}, true),
                             render(scene, camera, view_of({99, 55}, 2), {.keep_all = true}, true)),
              0u);

    // Frame 2 twice: nothing moves. Lit, since the environment is black.
    FrameView still = view_of({99, 55}, 2);
    still.previous_frame = 2;
    const auto names = [&] {
        std::set<std::string> names;
        for (const LeftOut& part : left_out_of_rasterizer(derive_facts(scene, camera, std::array{2u, 2u})))
            names.insert(part.what);
        return names;
    };
    const auto expect_same_bits = [&](const std::string& what) {
        EXPECT_EQ(differing_bits(render(scene, camera, still, {.is_still = true}, true),
                                 render(scene, camera, still, {.keep_all = true}, true)),
                  0u)
            << what;
    };
    scene.environment = {};
    EXPECT_EQ(names(),
              (std::set<std::string>{"vertex colours", "motion vectors", "fallback", "prefiltered environment"}));
    expect_same_bits("a still scene, a black environment");
    scene.instances.resize(2);  // the floor and what has textures, but no normal maps and no masks
    EXPECT_EQ(names(), (std::set<std::string>{"vertex colours", "motion vectors", "fallback", "prefiltered environment",
                                              "normal maps", "alpha tests"}));
    expect_same_bits("without normal maps");
    scene.instances.resize(1);
    expect_same_bits("without textures");
}

TEST(rasterizer, a_scene_without_geometry_is_all_sky) {
    Scene scene = varied_scene();
    scene.instances.clear();
    scene.environment = {.type = Environment::Type::constant, .color = {0.3f, 0.5f, 0.9f}};
    const SceneCamera camera = scene.camera("main");
    for (const DepthDirection direction : {DepthDirection::standard, DepthDirection::reversed}) {
        const HostGBuffer g = render(scene, camera, view_of({33, 17}, 1, direction), {}, true);
        for (size_t i = 0; i < g.depth.pixel_count(); ++i) {
            ASSERT_EQ(g.depth.values[i], direction == DepthDirection::reversed ? 0.0f : 1.0f);
            ASSERT_EQ(g.lit.rgb(i), scene.environment.color);
        }
        EXPECT_EQ(differing_bits(g, render(scene, camera, view_of({33, 17}, 1, direction), {.keep_all = true}, true)),
                  0u);
    }
}

TEST(rasterizer, a_frame_of_another_extent_is_an_error) {
    const Scene scene = varied_scene();
    Rasterizer rasterizer(test_device(), scene, {.extent = {16, 16}});
    EXPECT_THROW(rasterizer.render(scene.camera("main"), view_of({17, 16})), Error);
}

/// The fallback that the shader reads must be what the CPU's function says.
TEST(fallback, agrees_with_the_cpu) {
    Scene scene = varied_scene();
    scene.environment = {.type = Environment::Type::image, .latlong = HostImage({64, 32}, 3), .rotation = 0.7f};
    for (unsigned i = 0; i < 64 * 32; ++i)
        scene.environment.latlong.set_rgb(i, glm::vec3(i % 64 / 64.0f, i / 64 / 32.0f, 0.5f));
    const SceneCamera camera = scene.camera("main");
    const HostGBuffer g = render(scene, camera, view_of({120, 80}), {}, true);
    const PrefilteredEnvironment prefiltered = prefilter_environment(scene.environment);
    const CameraPose pose = pose_camera(camera, pose_scene(scene, 0), 0);
    for (unsigned y = 0; y < 80; ++y)
        for (unsigned x = 0; x < 120; ++x) {
            const glm::vec3 direction = camera_ray(pose, {120, 80}, {x + 0.5f, y + 0.5f}).direction;
            const float* n = g.normal.pixel(x, y);
            const bool is_sky = *g.material_id.pixel(x, y) == 0;
            const glm::vec3 expected = is_sky
                                           ? scene.environment.radiance(direction)
                                           : mean_over_lobe(scene.environment, prefiltered,
                                                            glm::reflect(direction, glm::vec3(n[0], n[1], n[2])), n[3]);
            const HostImage& image = is_sky ? g.lit : g.fallback;
            // Drivers approximate acos and atan to some 1e-4 rad: 1e-3 of a texel times a slope of 1 per texel at the
            // seam.
            for (int c = 0; c < 3; ++c) ASSERT_NEAR(image.pixel(x, y)[c], expected[c], 2e-3f) << x << ", " << y;
        }
}

class lit_direct_of : public testing::TestWithParam<Scene (*)()> {};
INSTANTIATE_TEST_SUITE_P(scenes, lit_direct_of, testing::Values(varied_scene, dielectric_scene));

TEST_P(lit_direct_of, a_directional_light_agrees_with_the_formula) {
    Scene scene = GetParam()();
    scene.lights.erase(scene.lights.begin());
    scene.lights.pop_back();
    scene.environment = {.type = Environment::Type::constant, .color = {0, 0, 0}};
    const SceneCamera camera = scene.camera("main");
    const HostGBuffer g = render(scene, camera, view_of({64, 48}), {}, true);
    const CameraPose pose = pose_camera(camera, pose_scene(scene, 0), 0);
    size_t lit = 0;
    for (unsigned y = 0; y < 48; ++y)
        for (unsigned x = 0; x < 64; ++x) {
            const float *n = g.normal.pixel(x, y), *gn = g.geometric_normal.pixel(x, y), *c = g.base_color.pixel(x, y),
                        *e = g.emission.pixel(x, y);
            const glm::vec3 o = -camera_ray(pose, {64, 48}, {x + 0.5f, y + 0.5f}).direction,
                            i = -scene.lights[0].direction;
            const float mu_i = glm::dot(glm::vec3(n[0], n[1], n[2]), i);
            glm::vec3 expected(e[0], e[1], e[2]);
            if (mu_i > 0 && glm::dot(glm::vec3(gn[0], gn[1], gn[2]), i) > 0) {
                const glm::vec3 f0 =
                    g.dielectric_f0.values.empty() ? glm::vec3(0.04f) : g.dielectric_f0.rgb(size_t(y) * 64 + x);
                const float largest = std::max({f0.x, f0.y, f0.z});
                const float fresnel =
                    glm::mix(largest * e[3], e[3], schlick_weight(glm::dot(i, glm::normalize(i + o))));
                expected +=
                    (1 - c[3]) * (1 - fresnel) * glm::vec3(c[0], c[1], c[2]) / pi * mu_i * scene.lights[0].intensity;
                ++lit;
            }
            for (int k = 0; k < 3; ++k)
                ASSERT_NEAR(g.lit.pixel(x, y)[k], expected[k], 1e-4f) << x << ", " << y;  // float32 sums
        }
    EXPECT_GT(lit, 500u);
}

/// The largest errors of oct16 and oct32 are those that Cigolle et al. 2014 measured over the sphere (table 2): 0.951
/// and 0.00372 degrees.
TEST(rasterizer, stores_normals_in_as_many_bits_as_asked) {
    const Scene scene = load_scene("furnace_sphere", scene_search_path());
    const glm::uvec2 extent(512, 512);
    const auto normals = [&](unsigned bits) {
        Rasterizer rasterizer(test_device(), scene, {.extent = extent, .normal_bits = bits});
        const GBuffer gbuffer = rasterizer.render(scene.camera("main"), view_of(extent));
        return std::pair(rasterizer.pass_list().download(gbuffer.normal),
                         rasterizer.pass_list().download(gbuffer.geometric_normal));
    };
    const auto [exact, exact_geometric] = normals(0);
    for (const auto& [bits, largest] : {std::pair(8u, 0.951), {16u, 0.00372}}) {
        const auto [stored, geometric] = normals(bits);
        EXPECT_EQ(geometric.values, exact_geometric.values);
        double worst = 0;
        size_t drawn = 0;
        for (size_t i = 0; i < stored.pixel_count(); ++i) {
            const glm::dvec3 a(exact.rgb(i)), b(stored.rgb(i));
            if (glm::length(a) == 0) continue;
            ++drawn;
            EXPECT_NEAR(glm::length(b), 1, 1e-6);
            EXPECT_EQ(stored.values[4 * i + 3], exact.values[4 * i + 3]) << "roughness";
            worst =
                std::max(worst, glm::degrees(2 * std::asin(0.5 * glm::distance(glm::normalize(a), glm::normalize(b)))));
        }
        EXPECT_GT(drawn, 2000u);
        EXPECT_LE(worst, largest + 1e-4) << "with the rounding of floats";
        EXPECT_GT(worst, 0.7 * largest) << "of a sphere some are nearly as bad";
    }
}
