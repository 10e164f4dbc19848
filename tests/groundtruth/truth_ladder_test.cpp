// The truth ladder of whole references: its file, its bits, its errors, and the summary that is printed.
#include "groundtruth/reference/truth_ladder.h"
#include "core/error.h"
#include "core/scene/load_scene.h"
#include "groundtruth/reference/reference_error.h"
#include "groundtruth/reference/reference_file.h"
#include "groundtruth/scene/camera_view.h"
#include "tests/groundtruth/test_scene.h"

#include <gtest/gtest.h>
#include <cmath>
#include <random>

namespace fs = std::filesystem;

namespace {

constexpr glm::uvec2 extent(32, 18);

struct Shot {
    Scene scene;
    ScenePose pose;
    CameraPose camera;

    Reference render(const ReferenceSettings& settings) const {
        return render_reference(scene, pose, camera, extent, settings);
    }
};

Shot load(const std::string& name) {
    Shot shot{load_scene(name, {fs::path(SSRLAB_SOURCE_DIR) / "scenes"}), {}, {}};
    shot.pose = pose_scene(shot.scene, 0);
    shot.camera = pose_camera(shot.scene.cameras.front(), shot.pose, 0);
    return shot;
}

/// A perfect mirror from horizon to horizon under a bright sheet that the image does not show; sky 0.3.
Shot hidden_sheet() {
    TestScene scene;
    scene.quad({-90, 0, 90}, {90, 0, 90}, {90, 0, -90}, {-90, 0, -90}, scene.add(metal_material(1, 0)));
    scene.quad({-90, 30, -90}, {90, 30, -90}, {90, 30, 90}, {-90, 30, 90}, scene.add(lambert_material(0, 5)));
    scene.scene.environment.color = glm::vec3(0.3f);
    scene.scene.content_hash = "hidden sheet";
    CameraPose camera = looking_along({0, 1, 0}, {0, -1, -1});
    camera.is_orthographic = false;
    camera.vertical_fov = 0.5f;
    return {scene.scene, scene.pose(), camera};
}

ReferenceOutput output(size_t pixels) {
    ReferenceOutput result;
    for (HostImage* image : {&result.mean, &result.half_a, &result.half_b, &result.variance})
        *image = HostImage({unsigned(pixels), 1}, 3);
    return result;
}

}  // namespace

TEST(truth_ladder, changes_no_bit_of_the_other_outputs_and_is_another_reference) {
    const Shot shot = load("offscreen_mirror");
    const Reference with = shot.render({.max_samples = 64, .ladder = true}), without = shot.render({.max_samples = 64});
    EXPECT_EQ(with.image.mean.values, without.image.mean.values);
    EXPECT_EQ(with.incident.half_a.values, without.incident.half_a.values);
    EXPECT_EQ(with.specular.variance.values, without.specular.variance.values);
    EXPECT_NE(with.hash, without.hash);
    EXPECT_TRUE(without.ladder.is_empty());
    EXPECT_GT(with.rays, without.rays);
    EXPECT_EQ(with.non_finite_samples, 0u);
}

TEST(truth_ladder, survives_its_file) {
    const fs::path file = fs::temp_directory_path() / "truth_ladder_test.exr";
    const ReferenceSettings settings{.max_samples = 16, .ladder = true};
    Reference reference = load("offscreen_mirror").render(settings);
    write_reference(file, reference, settings);
    const Reference back = read_reference(file);
    for (const auto& [a, b] : {std::pair(&reference.ladder.camera_radiance, &back.ladder.camera_radiance),
                               {&reference.ladder.on_screen, &back.ladder.on_screen}}) {
        EXPECT_EQ(a->mean.values, b->mean.values);
        EXPECT_EQ(a->half_b.values, b->half_b.values);
        EXPECT_EQ(a->variance.values, b->variance.values);
    }
    EXPECT_EQ(reference.ladder.on_screen_share.values, back.ladder.on_screen_share.values);
    EXPECT_EQ(reference.ladder.reflectance.values, back.ladder.reflectance.values);
    EXPECT_EQ(reference.ladder.fallback.values, back.ladder.fallback.values);
    EXPECT_EQ(reference.highlights.values, back.highlights.values);
    fs::remove(file);
}

TEST(truth_ladder, rungs_of_other_seeds_differ_by_their_stated_variance) {
    const Shot shot = load("roughness_gradient");
    double sum[2] = {};
    size_t count[2] = {};
    constexpr unsigned pairs = 12;
    for (unsigned pair = 0; pair < pairs; ++pair) {
        const Reference a = shot.render({.max_samples = 64, .seed = 2 * pair, .ladder = true}),
                        b = shot.render({.max_samples = 64, .seed = 2 * pair + 1, .ladder = true});
        for (const bool is_on_screen : {false, true}) {
            const ReferenceOutput &x = is_on_screen ? a.ladder.on_screen : a.ladder.camera_radiance,
                                  &y = is_on_screen ? b.ladder.on_screen : b.ladder.camera_radiance;
            for (size_t i = 0; i < x.mean.values.size(); i += 3) {  // red: the other channels share its paths
                const double variance = double(x.variance.values[i]) + y.variance.values[i];
                if (variance <= 1e-12) continue;  // float32 rounding of means near 1
                sum[is_on_screen] += std::pow(double(x.mean.values[i]) - y.mean.values[i], 2) / variance;
                ++count[is_on_screen];
            }
        }
    }
    // z^2 of normal noise with 28 degrees of freedom has mean 28/26 = 1.077. Twelve other dozens of pairs gave 1.069
    // with a standard deviation of 0.026: the bounds are 4.6 of them away (4e-6).
    for (const bool is_on_screen : {false, true}) {
        ASSERT_GT(count[is_on_screen], 1200u);
        EXPECT_GT(sum[is_on_screen] / double(count[is_on_screen]), 0.95);
        EXPECT_LT(sum[is_on_screen] / double(count[is_on_screen]), 1.19);
    }
}

TEST(truth_ladder, summary_of_what_is_hidden) {
    const LadderSummary summary = summarize_ladder(hidden_sheet().render({.max_samples = 64, .ladder = true}));
    ASSERT_EQ(summary.rungs.size(), 3u);
    EXPECT_EQ(summary.pixels, size_t(extent.x * extent.y));
    // One in 1e4 samples leaves along the lobe's tails (alpha = 0.001), past the sheet or to where it is on screen.
    EXPECT_NEAR(summary.mean_specular, 5, 5e-3);
    EXPECT_NEAR(summary.on_screen_share, 0, 1e-3);
    EXPECT_NEAR(summary.rungs[0].step.mean, 0, 5e-3);  // split-sum: the table's albedo of a mirror is 1 to 1e-3
    EXPECT_NEAR(summary.rungs[1].step.mean, 0, 1e-6);
    EXPECT_NEAR(summary.rungs[2].step.mean, 0.3 - 5, 1e-2);
    EXPECT_NEAR(summary.rungs[2].step.square, 4.7 * 4.7, 0.1);
    EXPECT_NEAR(summary.rungs[2].from_truth.mean,
                summary.rungs[0].step.mean + summary.rungs[1].step.mean + summary.rungs[2].step.mean, 1e-9);
}

TEST(truth_ladder, differences_come_without_noise_and_with_its_size) {
    // 100 draws of 2000 pixels: shared noise of 1, noise of its own of 0.3 on the lower image, a difference of 0.05 i.
    std::mt19937 generator(1);
    std::normal_distribution<double> normal;
    const size_t pixels = 2000, draws = 100;
    const std::vector<uint8_t> inside(pixels, 1);
    double mean_z = 0, square_z = 0, mean_error = 0, square_error = 0, true_square = 0;
    for (size_t draw = 0; draw < draws; ++draw) {
        ReferenceOutput upper = output(pixels), lower = output(pixels);
        double true_mean = 0;
        true_square = 0;
        for (size_t i = 0; i < pixels; ++i) {
            const double difference = 0.05 * double(i % 3);
            true_mean += difference / pixels;
            true_square += difference * difference / pixels;
            for (auto half : {&ReferenceOutput::half_a, &ReferenceOutput::half_b}) {
                const double shared = normal(generator), own = 0.3 * normal(generator);
                (upper.*half).set_rgb(i, glm::vec3(float(10 + shared)));
                (lower.*half).set_rgb(i, glm::vec3(float(10 + shared + difference + own)));
            }
        }
        const LadderDifference d = ladder_difference(upper, lower, inside);
        mean_z += (d.mean - true_mean) / d.mean_error / draws;
        square_z += (d.square - true_square) / d.square_error / draws;
        mean_error += d.mean_error / draws, square_error += d.square_error / draws;
    }
    // Means of 100 standard normal numbers: 5 standard errors (6e-7 each).
    EXPECT_NEAR(mean_z, 0, 0.5);
    EXPECT_NEAR(square_z, 0, 0.5);
    // The noise v = 0.09 of a half's difference makes the mean of both vary by v / 2, and their product by
    // 2 d^2 v + v^2. Over 2 10^5 pixels its estimate is known to 0.2 % and 0.5 %: 5 of these.
    const double v = 0.09;
    EXPECT_NEAR(mean_error / std::sqrt(v / 2 / pixels), 1, 0.01);
    EXPECT_NEAR(square_error / std::sqrt((2 * true_square * v + v * v) / pixels), 1, 0.025);
}

TEST(camera_view, frames_what_projects_into_the_image) {
    std::mt19937 generator(2);
    std::uniform_real_distribution<float> coordinate(-4, 4);
    for (const bool is_orthographic : {false, true}) {
        CameraPose pose = looking_along({0.5f, 1, 2}, {0.2f, -0.4f, -1});
        pose.is_orthographic = is_orthographic;
        pose.vertical_fov = 0.8f;
        pose.orthographic_height = 3;
        pose.near = 1e-3f;
        const CameraView view(pose, extent);
        const CameraData data = camera_data(pose, nullptr, {.extent = extent});
        int framed = 0;
        for (int i = 0; i < 2000; ++i) {
            const glm::vec3 point(coordinate(generator), coordinate(generator), coordinate(generator));
            const glm::vec4 clip = data.clip_from_world * glm::vec4(point, 1);
            const glm::vec3 ndc = glm::vec3(clip) / clip.w;
            const bool is_before = clip.w > 0 && ndc.z > 0;
            if (std::abs(std::max(std::abs(ndc.x), std::abs(ndc.y)) - 1) < 1e-4f)
                continue;  // at the border float32 decides
            const bool expected = is_before && std::abs(ndc.x) < 1 && std::abs(ndc.y) < 1;
            EXPECT_EQ(view.frames(point), expected);
            framed += expected;

            const CameraRay ray = camera_ray(pose, extent, (glm::vec2(ndc) * 0.5f + 0.5f) * glm::vec2(extent));
            const glm::vec3 start = point + view.to_eye(point);
            for (int axis = 0; axis < 3 && is_before; ++axis)
                EXPECT_NEAR(start[axis], ray.origin[axis], 2e-3);  // near / far of 1e-5 costs digits
            EXPECT_EQ(view.frames_direction(glm::normalize(point - view.eye())), expected && !is_orthographic);
        }
        EXPECT_GT(framed, 50);
    }
}
