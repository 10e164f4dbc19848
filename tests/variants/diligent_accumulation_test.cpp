// DiligentFX's temporal accumulation against closed forms: what becomes of history, and where the surface or its mirror
// image was. diligent_history_search_test.cpp asks what happens where something else was.
#include "tests/variants/accumulation_scene.h"

using namespace accumulation_scene;

namespace {

// ---- What becomes of history --------------------------------------------------------------------------------------

TEST_F(DiligentAccumulation, BlendsByItsTwoFactors) {
    scene.inputs.resolved.radiance =
        image_of(4, [](unsigned x, unsigned y) { return glm::vec4((x + y) & 1 ? 0.2f : 0.8f); });
    const Filtered found = run({{"temporal_radiance_stability_factor", 0.75}});
    EXPECT_NEAR(found.radiance.pixel(10, 10)[0], 0.25f * 0.8f + 0.75f * 0.5f, rounding);
    EXPECT_NEAR(found.radiance.pixel(11, 10)[3], 0.25f * 0.2f + 0.75f * 0.5f, rounding);
    scene.inputs.history.variance = HostImage(extent, 1, 0.75f);
    EXPECT_NEAR(*run({}).variance.pixel(10, 10), 0.1f * 0.25f + 0.9f * 0.75f, rounding);
}

/// A first frame's previous camera is its own.
TEST_F(DiligentAccumulation, FirstFrameHasNoHistoryUnlessItStartsFromBlack) {
    scene.inputs.camera = camera_data(scene.pose, nullptr, {.extent = extent});
    scene.inputs.resolved.radiance =
        image_of(4, [](unsigned x, unsigned y) { return glm::vec4((x + y) & 1 ? 0.2f : 0.8f); });
    scene.inputs.history = {HostImage(extent, 4), HostImage(extent, 1)};
    const Overrides overrides = {{"temporal_radiance_stability_factor", 0.75}};
    const Filtered found = run(overrides);
    EXPECT_EQ(found.radiance.values, scene.inputs.resolved.radiance.values);
    EXPECT_EQ(found.variance.values, HostImage(extent, 1, 1.0f).values);
    Overrides from_black = overrides;
    from_black["start_from_black"] = true;
    const Filtered blended = run(from_black);
    EXPECT_NEAR(blended.radiance.pixel(10, 10)[0], 0.25f * 0.8f, rounding);
    EXPECT_NEAR(*blended.variance.pixel(10, 10), 0.1f * 0.25f, rounding);
}

/// Of any 3x3 pixels, at the border those that the nearest stand for, whether the mask keeps them or not.
TEST_F(DiligentAccumulation, ClampsHistoryToTheNeighborhood) {
    const auto noise = [](unsigned x, unsigned y) {
        return glm::vec4(float((x * 37 + y * 61) % 17), float((x * 13 + y * 7) % 11), float(x % 5), float(y % 3)) /
               16.0f;
    };
    scene.inputs.resolved.radiance = image_of(4, noise);
    scene.inputs.history.radiance = HostImage(extent, 4, 10.0f);
    scene.inputs.mask = image_of(1, [](unsigned x, unsigned y) { return glm::vec4((x + y) % 3 == 0); });
    const Filtered found = run({});
    for (const glm::uvec2 pixel : {glm::uvec2(0, 0), glm::uvec2(24, 15), glm::uvec2(47, 31), glm::uvec2(47, 1)}) {
        ASSERT_EQ((pixel.x + pixel.y) % 3, 0u);
        glm::dvec4 sum(0), squares(0);
        for (int dy = -1; dy <= 1; ++dy)
            for (int dx = -1; dx <= 1; ++dx) {
                const glm::ivec2 at =
                    glm::clamp(glm::ivec2(pixel) + glm::ivec2(dx, dy), glm::ivec2(0), glm::ivec2(extent) - 1);
                const glm::dvec4 value = noise(unsigned(at.x), unsigned(at.y));
                sum += value, squares += value * value;
            }
        const glm::dvec4 mean = sum / 9.0, deviation = glm::sqrt(glm::max(squares / 9.0 - mean * mean, 0.0));
        // The root of a variance that rounding leaves of equal values, 1e-7, is 3e-4.
        for (int c = 0; c < 4; ++c)
            EXPECT_NEAR(found.radiance.pixel(pixel.x, pixel.y)[c], std::min(mean[c] + 2.5 * deviation[c], 10.0), 1e-3);
    }
}

/// What the facts measured on a rough floor, in the extreme: black lies within the box of noise about a mean of 0.5, so
/// that a history which began black stays so, whatever arrives.
TEST_F(DiligentAccumulation, NeverAveragesAtTheDefaultFactor) {
    const auto mean_after = [&](Overrides overrides, unsigned frames) {
        overrides.emplace("float_histories", true);
        AccumulationBench bench(device(), extent, overrides);
        AccumulationInputs inputs = scene.inputs;
        inputs.history = {HostImage(extent, 4), HostImage(extent, 1)};
        for (unsigned frame = 0; frame < frames; ++frame) {
            inputs.resolved.radiance =
                image_of(4, [&](unsigned x, unsigned y) { return glm::vec4((x + y + frame) & 1 ? 0.0f : 1.0f); });
            inputs.history = bench.accumulate(inputs);
        }
        double sum = 0;
        for (const float value : inputs.history.radiance.values) sum += value;
        return sum / double(inputs.history.radiance.values.size());
    };
    EXPECT_EQ(mean_after({}, 24), 0.0);
    // 1 - 0.9^24 of the mean has arrived: 0.46.
    EXPECT_NEAR(mean_after({{"temporal_radiance_stability_factor", 0.9}}, 24), 0.5 * (1 - std::pow(0.9, 24)), 1e-4);
}

TEST_F(DiligentAccumulation, FloatHistoriesKeepWhatHalvesLose) {
    const float grey = 0.25f + 0x1p-13f;  // midway between two halves
    scene.inputs.resolved.radiance = scene.inputs.history.radiance = HostImage(extent, 4, grey);
    EXPECT_NEAR(run({}).radiance.pixel(5, 5)[0], grey, rounding);
    EXPECT_GT(std::abs(run({{"float_histories", false}}).radiance.pixel(5, 5)[0] - grey), 1e-4f);
}

TEST_F(DiligentAccumulation, PassesThroughWhatItGetsWhenOff) {
    scene.inputs.resolved.radiance =
        image_of(4, [](unsigned x, unsigned y) { return glm::vec4(x, y, x + y, 1) / 64.0f; });
    scene.inputs.resolved.variance = image_of(1, [](unsigned x, unsigned) { return glm::vec4(ramp_x(float(x))); });
    const Filtered found = run({{"temporal_accumulation", false}});
    EXPECT_EQ(found.radiance.values, scene.inputs.resolved.radiance.values);
    EXPECT_EQ(found.variance.values, scene.inputs.resolved.variance.values);
}

TEST_F(DiligentAccumulation, ClearsWhatTheMaskLeavesOut) {
    for (const bool clear_targets : {false, true}) {
        AccumulationBench bench(device(), extent, {{"clear_targets", clear_targets}});
        AccumulationInputs inputs = scene.inputs;
        bench.accumulate(inputs);
        bench.accumulate(inputs);
        inputs.mask = HostImage(extent, 1);
        const Filtered found = bench.accumulate(inputs);  // writes what the first run wrote
        EXPECT_EQ(found.radiance.pixel(7, 7)[1], clear_targets ? 0.0f : 0.5f);
        EXPECT_EQ(*found.variance.pixel(7, 7) > 0, !clear_targets);
    }
}

// ---- Where history is looked for ----------------------------------------------------------------------------------

/// A camera that moved to the right: what it sees moved to the left, the mirror image half as far as the surface.
struct DiligentAccumulationMoved : DiligentAccumulation, testing::WithParamInterface<DepthDirection> {
    const float way = 1.0f;  // m

    float pixels_at(float distance) const {
        return way / distance * 0.5f * float(extent.y) / std::tan(0.5f * scene.pose.vertical_fov);
    }

    void SetUp() override {
        scene.view.depth_direction = GetParam();
        scene.pose.world_from_view[3].x = way;
        scene.update();
        for (size_t i = 0; i < extent.x * extent.y; ++i)
            scene.inputs.motion.values[2 * i] = -pixels_at(surface_distance) / float(extent.x);
        scene.inputs.history.radiance =
            image_of(4, [](unsigned x, unsigned) { return glm::vec4(ramp_x(float(x) + 0.5f)); });
    }
    /// Makes the image look like the history at that column.
    void shows(float x) { scene.inputs.resolved.radiance = HostImage(extent, 4, ramp_x(x)); }
};

TEST_P(DiligentAccumulationMoved, TakesTheCandidateThatLooksAlike) {
    const glm::vec2 surface = centre(middle) + glm::vec2(pixels_at(surface_distance), 0),
                    image = centre(middle) + glm::vec2(pixels_at(point_distance), 0);
    shows(surface.x);
    expect_position({}, middle, surface);
    shows(image.x);
    // The depth of the point is stored as a half: it, and the distance of 2 pixels that it stands for, is off by up to
    // a twentieth; of reversed depth, a half near 0, by a thousandth.
    expect_position({}, middle, image, GetParam() == DepthDirection::reversed ? 0.01f : 0.2f);
}

/// Steps of halves near 1 are 4.9e-4, 2 m at 20 m: of the 3.4 pixels they leave an error of some tenths.
TEST_P(DiligentAccumulationMoved, LinearHitDepthFindsDistantPoints) {
    const float distance = 19, error_of_halves = 0.03f;
    const float expected = float(middle.x) + 0.5f + pixels_at(distance);
    shows(expected);
    const auto error = [&](const Overrides& overrides, float hit_depth) {
        scene.inputs.hit_depth = HostImage(extent, 1, hit_depth);
        return std::abs(position_before(overrides, middle).x - expected);
    };
    EXPECT_LT(error({{"linear_hit_depth", true}}, distance), 1e-3f);
    const float with_halves = error({}, device_depth(scene.inputs.camera, distance));
    if (GetParam() == DepthDirection::standard) {
        EXPECT_GT(with_halves, error_of_halves);
    }
}

/// An orthographic camera sees all points move alike, by the way over the height of the image.
TEST_P(DiligentAccumulationMoved, LinearHitDepthServesOrthographicCameras) {
    scene.pose.is_orthographic = scene.before.is_orthographic = true;
    scene.pose.orthographic_height = scene.before.orthographic_height = 8;
    const HostImage ramps = scene.inputs.history.radiance;
    scene.update();
    scene.inputs.history.radiance = ramps;
    scene.inputs.hit_depth = HostImage(extent, 1, point_distance);
    const glm::vec2 expected = centre(middle) + glm::vec2(way / 8 * float(extent.y), 0);
    shows(expected.x);
    expect_position({{"linear_hit_depth", true}}, middle, expected);
}

TEST_P(DiligentAccumulationMoved, HistoryBeyondTheScreenIsNone) {
    const glm::uvec2 last{extent.x - 1, 16};
    shows(centre(last).x + pixels_at(surface_distance));
    EXPECT_TRUE(std::isnan(position_before({}, last).x));
}

INSTANTIATE_TEST_SUITE_P(Depth, DiligentAccumulationMoved,
                         testing::Values(DepthDirection::standard, DepthDirection::reversed), [](const auto& info) {
                             return info.param == DepthDirection::standard ? "standard" : "reversed";
                         });

/// A camera that stood 20 m further ahead had the mirrored point behind it: its negative w turns it round to the other
/// side of the image. The surface lies there in the same place.
TEST_F(DiligentAccumulation, GuardPreviousClipRejectsPointsBehindTheCamera) {
    scene.before.world_from_view[3].z = -20;
    scene.update();
    const glm::uvec2 pixel{28, 16};
    // Behind the camera and 10 m away as before it, so that the image is turned about its centre.
    const glm::vec2 turned = glm::vec2(extent) - centre(pixel);
    scene.inputs.history.radiance =
        image_of(4, [](unsigned x, unsigned) { return glm::vec4(ramp_x(float(x) + 0.5f)); });
    scene.inputs.resolved.radiance = HostImage(extent, 4, ramp_x(turned.x));
    expect_position({{"linear_hit_depth", false}}, pixel, turned, 0.3f);  // depth stored as a half
    expect_position({{"guard_previous_clip", true}}, pixel, centre(pixel));
}

/// The pixels are taken for unjittered: samples that move within them are the same pixels.
TEST_F(DiligentAccumulation, JitterMovesNoHistory) {
    scene.view.jitter = {0.4f, -0.3f};
    scene.view.previous_jitter = {-0.2f, 0.1f};
    scene.update();
    expect_position({}, middle, centre(middle));
}

}  // namespace
