#include "tests/variants/diligent_frames.h"
#include "tests/variants/technique_fixture.h"

#include <random>

namespace {

/// A G-buffer of which only the depth matters.
HostGBuffer gbuffer_of(HostImage depth, bool is_reversed) {
    HostGBuffer gbuffer;
    gbuffer.camera.extent = {depth.extent, 1.0f / glm::vec2(depth.extent)};
    gbuffer.camera.depth = {0.1f, 100.0f, is_reversed ? 0.0f : 1.0f, is_reversed};
    gbuffer.depth = std::move(depth);
    return gbuffer;
}

std::vector<HostImage> hierarchy_of(Device& device, const HostGBuffer& gbuffer, const std::string& form) {
    DiligentFrames frames(device, gbuffer.extent(), {{"hierarchy", form}});
    frames.begin(gbuffer);
    const Image hierarchy =
        diligent_depth_hierarchies(frames.pass_list, frames.gbuffer, frames.parameters.tracing).nearest;
    std::vector<HostImage> levels;
    for (unsigned level = 0; level < hierarchy.mips; ++level)
        levels.push_back(frames.pass_list.download(hierarchy.mip(level)));
    return levels;
}

/// The nearest depth of all texels of `depth` that texel (x, y) of a level is to stand for: of 2x2 texels of the level
/// below, or of a third row or column where that level is odd.
float nearest_of(const std::vector<HostImage>& finer, unsigned level, unsigned x, unsigned y, bool is_reversed) {
    if (level == 0) return *finer[0].pixel(x, y);
    const glm::uvec2 extent = max(finer[0].extent >> (level - 1), 1u), count = 2u + extent % 2u;
    float nearest = is_reversed ? 0.0f : 1.0f;
    for (unsigned row = 2 * y; row < std::min(2 * y + count.y, extent.y); ++row)
        for (unsigned column = 2 * x; column < std::min(2 * x + count.x, extent.x); ++column) {
            const float depth = *finer[level - 1].pixel(column, row);
            nearest = is_reversed ? std::max(nearest, depth) : std::min(nearest, depth);
        }
    return nearest;
}

void expect_hierarchy(const std::vector<HostImage>& levels, const HostImage& depth, bool is_reversed) {
    unsigned longest = std::max(depth.extent.x, depth.extent.y), count = 1;
    while (longest > 1 && count < 7) longest /= 2, ++count;
    ASSERT_EQ(levels.size(), count);
    EXPECT_EQ(levels[0].values, depth.values);
    for (unsigned level = 1; level < levels.size(); ++level) {
        ASSERT_EQ(levels[level].extent, max(depth.extent >> level, 1u));
        size_t wrong = 0;
        for (unsigned y = 0; y < levels[level].extent.y; ++y)
            for (unsigned x = 0; x < levels[level].extent.x; ++x)
                wrong += *levels[level].pixel(x, y) != nearest_of(levels, level, x, y, is_reversed);
        EXPECT_EQ(wrong, 0u) << "level " << level;
    }
}

struct DiligentHierarchy : TechniqueTest {};

TEST_F(DiligentHierarchy, HoldsTheNearestOfEachFootprintAtAnySizeInBothForms) {
    std::mt19937 random(5);
    std::uniform_real_distribution<float> value(0.0f, 1.0f);
    for (const glm::uvec2 extent :
         {glm::uvec2(64, 64), glm::uvec2(1, 1), glm::uvec2(2, 1), glm::uvec2(1, 9), glm::uvec2(7, 5),
          glm::uvec2(63, 65), glm::uvec2(130, 3), glm::uvec2(511, 287), glm::uvec2(333, 187)})
        for (const bool is_reversed : {false, true}) {
            SCOPED_TRACE(testing::Message() << extent.x << "x" << extent.y << (is_reversed ? ", reversed" : ""));
            HostImage depth(extent, 1);
            for (float& d : depth.values) d = value(random);
            const HostGBuffer gbuffer = gbuffer_of(depth, is_reversed);
            const std::vector<HostImage> levels = hierarchy_of(device(), gbuffer, "intermediate");
            expect_hierarchy(levels, depth, is_reversed);
            const std::vector<HostImage> of_views = hierarchy_of(device(), gbuffer, "mip_views");
            ASSERT_EQ(of_views.size(), levels.size());
            for (size_t level = 0; level < levels.size(); ++level)
                EXPECT_EQ(of_views[level].values, levels[level].values) << level;
        }
}

/// Every pixel must be seen by the last texel that stands for it: a march that steps over a texel skips all of them.
TEST_F(DiligentHierarchy, NoPixelIsLeftOverByOddSizes) {
    for (const glm::uvec2 extent : {glm::uvec2(511, 287), glm::uvec2(333, 187)})
        for (const glm::uvec2 pixel : {extent - 1u, glm::uvec2(extent.x - 1, 3), glm::uvec2(5, extent.y - 1)}) {
            HostImage depth(extent, 1, 1.0f);
            *depth.pixel(pixel.x, pixel.y) = 0.25f;
            const std::vector<HostImage> levels = hierarchy_of(device(), gbuffer_of(depth, false), "intermediate");
            for (const HostImage& level : levels) EXPECT_EQ(std::ranges::min(level.values), 0.25f) << level.extent.x;
        }
}

struct DiligentHierarchyOf : TechniqueTest, testing::WithParamInterface<std::string> {};

TEST_P(DiligentHierarchyOf, EqualsTheOriginals) {
    const HostGBuffer gbuffer = diligent_golden_gbuffer(GetParam());
    for (const char* form : {"intermediate", "mip_views"}) {
        const std::vector<HostImage> levels = hierarchy_of(device(), gbuffer, form);
        ASSERT_EQ(levels.size(), 7u);
        EXPECT_EQ(levels[0].values, gbuffer.depth.values);
        for (unsigned level = 1; level < 7; ++level) {
            const std::string file = GetParam() + "/hiz_mip" + std::to_string(level) + ".exr";
            EXPECT_EQ(levels[level].values, golden_layer(read_golden(file), "depth").values) << form << ", " << file;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(golden_diligent_hierarchy, DiligentHierarchyOf,
                         testing::ValuesIn(diligent_sets_with("hiz_mip1.exr")),
                         [](const auto& info) { return golden_test_name(info.param); });

}  // namespace
