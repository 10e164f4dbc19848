// When the denoiser ratio_accumulation gives up history: what changes, what moves, and what is noise alone.
#include "tests/variants/ratio_accumulation_fixture.h"

namespace {

/// From 1 to 4 after 100 frames, with a quarter of noise either way. Compressed that is from 0.5 to 0.8 with deviations
/// of 0.036, so that the lasting mean is kept within 2 * 0.036 / sqrt(7) + 0.01 = 0.037 of the recent one, which closes
/// a quarter of the gap in each of change_frames = 4. At 44 % of the way, 0.70, the lasting one is then in the sixth
/// frame. The last 0.037 are a quarter of the light; they go as the frames of before, which count less for having been
/// moved, are outnumbered. Of 100 that are not moved n new ones have n / (100 + n).
TEST_F(RatioAccumulationTest, ChangesOfLightShortenHistory) {
    roughness = 0.5f;
    const auto frames_to_follow = [&](double deviations, double share, int most) {
        DenoiserBench step = bench({{"reuse_neighbors", false}, {"change_deviations", deviations}});
        for (int frame = 1 - 100; frame <= most; ++frame) {
            HostImage colors = any_colors();
            for (float& value : colors.values) value = (frame > 0 ? 4.0f : 1.0f) * (0.75f + 0.5f * value);
            if (spread_of(step.next(drawn(colors))).mean > 1 + share * 3) return frame;
        }
        return most + 1;
    };
    EXPECT_LE(frames_to_follow(2, 0.44, 12), 8) << "two more than without noise";
    EXPECT_LE(frames_to_follow(2, 0.9, 80), 50) << "half of the frames before; 900 if none was moved";
    EXPECT_NEAR(frames_to_follow(0, 0.44, 80), 0.44 / 0.56 * 100, 2);
}

/// One ray in 50 is 100 times as bright, and three count each frame. Variances are those of the same rays, about the
/// mean that is known.
TEST_F(RatioAccumulationTest, NoiseIsNoChange) {
    extent = {24, 24};
    const auto variance = [&](double deviations) {
        DenoiserBench noisy = bench({{"change_deviations", deviations}});
        random.seed(1);
        double squares = 0;
        for (int frame = 0; frame < 260; ++frame) {
            HostImage colors(extent, 3);
            for (size_t i = 0; i < colors.pixel_count(); ++i)
                colors.set_rgb(i, glm::vec3(uniform(random) < 0.02f ? 100.0f : 1.0f));
            const HostImage found = noisy.next(drawn(colors));
            if (frame < 180) continue;  // max_history is 160
            for (size_t i = 0; i < found.pixel_count(); ++i) squares += std::pow(double(found.rgb(i).r) - 2.98, 2);
        }
        return squares;
    };
    EXPECT_LE(variance(2), 1.5 * variance(0));
}

/// White after three black frames; all rays hit one pixel. Motion of moved_pixels takes half of the history.
TEST_F(RatioAccumulationTest, HitsThatMoveEndHistory) {
    const glm::uvec2 hit(15, 11);
    const auto share_of_new = [&](float pixels) {
        DenoiserBench moving = bench(of_means);
        RayFrame rays = drawn(0);
        rays.motion = [=](glm::uvec2 pixel) { return glm::vec2(0, pixel == hit ? pixels / 12 : 0.0f); };
        rays.change = [=, this](glm::uvec2 pixel, StoredRay& ray) {
            drawn_from_lobe()(pixel, ray);
            ray.target = packed(hit);
        };
        for (int i = 0; i < 3; ++i) moving.next(rays);
        rays.color = [](glm::uvec2) { return glm::vec3(1); };
        return middle_of(moving.next(rays));
    };
    EXPECT_NEAR(share_of_new(0), 1.0 / 4, 1e-3);
    // The frames before moved, too: 1, then 1 + 1/2, then 1 + 3/4.
    EXPECT_NEAR(share_of_new(0.2f), 1 / (1 + 0.5 * (1 + 0.75)), 1e-3);
    EXPECT_GT(share_of_new(20), 0.98);
}

/// What stands still beside a camera that moves is as good as at rest. History is read between texels of one value.
TEST_F(RatioAccumulationTest, MotionOfTheCameraIsNoneOfHits) {
    roughness = 0.8f;
    DenoiserBench moving = bench(of_means);
    HostImage found;
    for (int frame = 0; frame < 4; ++frame) {
        move_to(moving, float(frame) * glm::vec3(0.3f, 0.2f, 0));
        found = moving.next(drawn(frame == 3 ? 1.0f : 0.0f));
    }
    EXPECT_NEAR(middle_of(found), 1.0 / 4, 2e-3);
}

/// A mirror's image moves on the screen with the distance of what it shows. Of history of moving_history = 1 a parallax
/// of one pixel takes half. Lengths between texels are off by up to 1 %, and so are pixels.
TEST_F(RatioAccumulationTest, HistoryOfAnotherDistanceIsRefused) {
    extent = {64, 48};
    roughness = 0;
    const float pixels_at_one = float(extent.y) / 2 / std::tan(pose.vertical_fov / 2), depth_before = 6;
    const auto share_of_new = [&](float parallax) {
        const float depth_now = pixels_at_one / (pixels_at_one / depth_before - parallax);
        DenoiserBench mirror = bench(of_means);
        const auto show = [&](float value, float depth) {
            RayFrame rays = drawn(value);
            rays.change = [=, this](glm::uvec2 pixel, StoredRay& ray) {
                drawn_from_lobe()(pixel, ray);
                ray.length = (depth - wall_distance) / ray.direction.z;
            };
            return middle_of(mirror.next(rays));
        };
        for (int i = 0; i < 3; ++i) show(0, depth_before);
        move_to(mirror, {1, 0, 0});
        return show(1, depth_now);
    };
    const double weight = 1 + 0.01;  // least_ratio
    EXPECT_NEAR(share_of_new(0), weight / (weight + 1), 0.01);
    EXPECT_NEAR(share_of_new(1), weight / (weight + 0.5), 0.01);
    EXPECT_GT(share_of_new(5), 0.95);
}

}  // namespace
