#include "tests/variants/amd_golden.h"
#include "tests/variants/technique_fixture.h"

#include <random>

namespace {

/// Mips of the pyramid of `depth`, as the pass_list's device makes them.
std::vector<HostImage> pyramid_of(Device& device, const HostImage& depth, bool is_reversed, unsigned mips,
                                  bool keeps_farthest = false) {
    PassList pass_list(device, depth.extent);
    AmdParameters parameters;
    CameraData camera{};
    camera.extent = {depth.extent, 1.0f / glm::vec2(depth.extent)};
    camera.depth = {0.1f, 100.0f, is_reversed ? 0.0f : 1.0f, is_reversed};
    const Image image = pass_list.image("depth", Format::r32f);
    pass_list.upload(image, depth);
    std::vector<HostImage> levels;
    for (int frame = 0; frame < 2; ++frame) {  // the second finds out whether the counter has been rewound
        pass_list.begin_frame(camera, parameters.params, std::span(&image, 1));
        const Image pyramid = depth_pyramid(pass_list, image, mips, keeps_farthest);
        levels.clear();
        for (unsigned level = 0; level < pyramid.mips; ++level)
            levels.push_back(pass_list.download(pyramid.mip(level)));
        pass_list.clear(pyramid, glm::vec4(0.5f));
    }
    return levels;
}

/// The level above, of floor(size / 2), at least 1: largest or smallest of 2x2, of which one exists only where a level
/// is one texel wide or high.
HostImage reduce(const HostImage& fine, bool keeps_largest) {
    HostImage coarse(max(fine.extent / 2u, 1u), 1);
    for (unsigned y = 0; y < coarse.extent.y; ++y)
        for (unsigned x = 0; x < coarse.extent.x; ++x) {
            float kept = *fine.pixel(2 * x, 2 * y);
            for (unsigned i = 1; i < 4; ++i) {
                const float depth =
                    *fine.pixel(std::min(2 * x + i % 2, fine.extent.x - 1), std::min(2 * y + i / 2, fine.extent.y - 1));
                kept = keeps_largest ? std::max(kept, depth) : std::min(kept, depth);
            }
            *coarse.pixel(x, y) = kept;
        }
    return coarse;
}

/// `expected`: its finest level.
void expect_pyramid(Device& device, const HostImage& depth, bool is_reversed, bool keeps_farthest, HostImage expected) {
    const std::vector<HostImage> levels = pyramid_of(device, depth, is_reversed, 13, keeps_farthest);
    const bool keeps_largest = is_reversed != keeps_farthest;
    for (size_t level = 0; level < levels.size(); ++level) {
        ASSERT_EQ(levels[level].extent, expected.extent);
        EXPECT_EQ(levels[level].values, expected.values) << "level " << level << " of " << depth.extent.x << "x"
                                                         << depth.extent.y << (is_reversed ? ", reversed" : "");
        expected = reduce(expected, keeps_largest);
    }
}

struct DepthPyramid : TechniqueTest {};

/// Each of them also where a third of the pixels shows nothing, which is as near as can be among the farthest.
TEST_F(DepthPyramid, HoldsTheNearestAndTheFarthestOfEachBlockAtAnySize) {
    std::mt19937 random(5);
    std::uniform_real_distribution<float> value(0.0f, 1.0f);
    for (const glm::uvec2 extent :
         {glm::uvec2(64, 64), glm::uvec2(1, 1), glm::uvec2(2, 1), glm::uvec2(7, 5), glm::uvec2(63, 65),
          glm::uvec2(641, 361), glm::uvec2(130, 3), glm::uvec2(1037, 517), glm::uvec2(4225, 70)})
        for (const bool is_reversed : {false, true}) {
            HostImage depth(extent, 1);
            const float background = is_reversed ? 0.0f : 1.0f;
            for (float& d : depth.values) d = random() % 3 ? value(random) : background;
            expect_pyramid(device(), depth, is_reversed, false, depth);
            HostImage surfaces = depth;
            for (float& d : surfaces.values) d = d == background ? 1 - background : d;
            expect_pyramid(device(), depth, is_reversed, true, surfaces);
        }
}

TEST_F(DepthPyramid, HasNoMoreLevelsThanAskedFor) {
    EXPECT_EQ(pyramid_of(device(), HostImage({300, 200}, 1, 0.25f), false, 7).size(), 7u);
    EXPECT_EQ(pyramid_of(device(), HostImage({300, 200}, 1, 0.25f), false, 3).size(), 3u);
    EXPECT_EQ(pyramid_of(device(), HostImage({300, 200}, 1, 0.25f), false, 13).size(), 9u);  // 300 halves 8 times
}

struct AmdPyramidOf : TechniqueTest, testing::WithParamInterface<std::string> {};

TEST_P(AmdPyramidOf, EqualsTheOriginals) {
    const HostImage depth = golden_layer(read_golden(GetParam() + "/gbuffer.exr"), "depth");
    const std::vector<HostImage> levels = pyramid_of(device(), depth, false, 7);
    ASSERT_EQ(levels.size(), 7u);
    EXPECT_EQ(levels[0].values, depth.values);
    for (unsigned level = 1; level < 7; ++level) {
        const std::string file = GetParam() + "/hiz_mip" + std::to_string(level) + ".exr";
        EXPECT_EQ(levels[level].values, golden_layer(read_golden(file), "depth").values) << file;
    }
}

INSTANTIATE_TEST_SUITE_P(golden_amd_pyramid, AmdPyramidOf, testing::ValuesIn(amd_tracer_sets()),
                         [](const auto& info) { return golden_test_name(info.param); });

}  // namespace
