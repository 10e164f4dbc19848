// Where DiligentFX's temporal accumulation looks for history if the previous frame showed something else in its place.
#include "tests/variants/accumulation_scene.h"

using namespace accumulation_scene;

namespace {

constexpr float occluder_distance = 0.5f;  // exp(-0.9) = 0.41: less alike than any texel may be

/// To the left of a column something else was seen, beside it the surface: the first position of a search that finds it
/// lies one row above.
TEST_F(DiligentAccumulation, SearchesForTheSurfaceNearby) {
    scene.was_at([](unsigned x, unsigned) { return x < middle.x ? occluder_distance : surface_distance; });
    const glm::uvec2 pixel = middle - glm::uvec2(1, 0);
    for (const char* search : {"camera_depth", "device_depth"}) {
        expect_position({{"history_search", search}}, pixel, centre(pixel) + glm::vec2(1, -1));
        expect_position({{"history_search", search}, {"centered_search", true}}, pixel,
                        centre(pixel) + glm::vec2(1, 0));
    }
}

/// Wherever two texels around a pixel show the surface, the search takes the one that it looks at first.
TEST_F(DiligentAccumulation, CenteredSearchTakesTheNearestAndOfThoseTheUpperAndLeft) {
    const glm::ivec2 order[9] = {{0, 0}, {0, -1}, {-1, 0}, {1, 0}, {0, 1}, {-1, -1}, {1, -1}, {-1, 1}, {1, 1}};
    const auto pixel_of = [](int pair) { return glm::ivec2(3 + 5 * pair, 16); };  // neighbourhoods do not overlap
    scene.was_at([&](unsigned x, unsigned y) {
        for (int pair = 0; pair < 8; ++pair)
            for (const glm::ivec2 shift : {order[pair], order[pair + 1]})
                if (glm::ivec2(x, y) == pixel_of(pair) + shift) return surface_distance;
        return occluder_distance;
    });
    for (const char* search : {"camera_depth", "device_depth"}) {
        const HostImage found = positions_before({{"history_search", search}, {"centered_search", true}});
        for (int pair = 0; pair < 8; ++pair) {
            const glm::ivec2 pixel = pixel_of(pair), expected = pixel + order[pair];
            const float* position = found.pixel(unsigned(pixel.x), unsigned(pixel.y));
            EXPECT_NEAR(position[0], float(expected.x) + 0.5f, 1e-3f) << search << ", " << pair;
            EXPECT_NEAR(position[1], float(expected.y) + 0.5f, 1e-3f) << search << ", " << pair;
        }
    }
}

/// At 8 m where 5 m are expected all texels are alike enough to be taps, but none to be history without a search.
TEST_F(DiligentAccumulation, CenteredSearchBeginsAtThePositionItself) {
    scene.was_at([](unsigned, unsigned) { return 8.0f; });
    expect_position({{"centered_search", true}}, middle, centre(middle));
    expect_position({}, middle, centre(middle) - 1.0f);
}

/// 5.55 m then and 5 m now differ by 0.099 of the greater and 0.11 of the former; 0.105 is alike.
TEST_F(DiligentAccumulation, LikenessIsOfTheGreaterDistance) {
    scene.was_at([](unsigned, unsigned) { return 5.55f; });
    expect_position({}, middle, centre(middle));
    EXPECT_TRUE(std::isnan(position_before({{"history_search", "device_depth"}}, middle).x));  // 2024: of now's
    scene.was_at([](unsigned, unsigned) { return 4.45f; });
    for (const char* search : {"camera_depth", "device_depth"})  // by 0.11 of the greater, which is now's: searched
        EXPECT_FALSE(position_before({{"history_search", search}}, middle) == centre(middle)) << search;
}

/// Two columns to the left of a pixel the surface was seen; its position before lies little to the left of the pixel,
/// so that of all nine positions' texels that column has but little weight.
TEST_F(DiligentAccumulation, SearchNeedsATenthOfTheTexels) {
    scene.was_at([](unsigned x, unsigned) { return x == middle.x - 2 ? surface_distance : occluder_distance; });
    const auto column_before = [&](float way) {
        for (size_t i = 0; i < extent.x * extent.y; ++i) scene.inputs.motion.values[2 * i] = way / float(extent.x);
        // Bright where the surface was, dark where its mirror image was.
        scene.inputs.history.radiance =
            image_of(4, [](unsigned x, unsigned) { return glm::vec4(x == middle.x ? 0 : 1); });
        scene.inputs.resolved.radiance = HostImage(extent, 4, way);
        return position_before({}, middle).x;
    };
    EXPECT_TRUE(std::isnan(column_before(0.05f)));
    EXPECT_NEAR(column_before(0.15f), centre(middle).x - 1.15f, 1e-3f);
}

/// The original reads the previous frame's depth buffer by its own planes, but the reprojected depth by this frame's.
TEST_F(DiligentAccumulation, PreviousDepthIsReadByThePreviousPlanes) {
    scene.before.near = 0.5f;
    scene.update();
    const CameraData before = camera_data(scene.before, nullptr, scene.view);
    scene.inputs.previous_depth = HostImage(extent, 1, device_depth(before, surface_distance));
    expect_position({}, middle, centre(middle));
}

TEST_F(DiligentAccumulation, WithoutHistoryTheVarianceIsOne) {
    scene.was_at([](unsigned, unsigned) { return occluder_distance; });
    scene.inputs.history.radiance = HostImage(extent, 4, 0.7f);
    scene.inputs.resolved.radiance = image_of(4, [](unsigned x, unsigned y) { return glm::vec4((x + y) & 1); });
    for (const char* search : {"camera_depth", "device_depth"}) {
        const Filtered found = run({{"history_search", search}});
        EXPECT_EQ(found.radiance.pixel(10, 11)[0], 1.0f) << search;
        EXPECT_EQ(*found.variance.pixel(10, 11), 1.0f) << search;
    }
}

/// The surface was seen between columns, half a pixel to the left; the colours of the columns there, in turn dark and
/// bright, make its history grey as the image is, and the mirror image's not.
struct DiligentAccumulationBetween : DiligentAccumulation {
    const glm::uvec2 pixel = middle - glm::uvec2(1, 0);

    void SetUp() override {
        for (size_t i = 0; i < extent.x * extent.y; ++i) scene.inputs.motion.values[2 * i] = 0.5f / float(extent.x);
        scene.inputs.resolved.radiance =
            image_of(4, [](unsigned x, unsigned y) { return glm::vec4(((x + y) & 1) ? 0.05f : 0.95f); });
        scene.inputs.history.radiance =
            image_of(4, [](unsigned x, unsigned) { return glm::vec4((x & 1) ? 0.25f : 0.75f); });
    }
};

/// A single column shows the surface: half of what lies around the first position that is found.
TEST_F(DiligentAccumulationBetween, TakesSingleTexelsOfTheSurface) {
    scene.was_at([](unsigned x, unsigned) { return x == middle.x ? surface_distance : occluder_distance; });
    for (const char* search : {"camera_depth", "device_depth"})
        EXPECT_NEAR(run({{"history_search", search}}).radiance.pixel(pixel.x, pixel.y)[0], 0.75f, rounding) << search;
}

/// Columns at 8 m and 5 m in turn: either is alike enough for a tap, but what 2024 filters, or averages, of their
/// values in the depth buffer is 6.2 m, which is not.
TEST_F(DiligentAccumulationBetween, FilteredDeviceDepthRejectsWhatTexelsPass) {
    scene.was_at([this](unsigned x, unsigned) { return (x & 1) == (pixel.x & 1) ? 8.0f : surface_distance; });
    const auto variance = [&](const char* search) {
        return *run({{"history_search", search}}).variance.pixel(pixel.x, pixel.y);
    };
    EXPECT_NEAR(variance("camera_depth"), 0.25f, rounding);
    EXPECT_EQ(variance("device_depth"), 1.0f);
}

}  // namespace
