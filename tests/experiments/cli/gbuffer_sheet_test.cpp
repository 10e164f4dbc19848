#include "experiments/cli/gbuffer_sheet.h"

#include "core/png.h"

#include <gtest/gtest.h>

namespace {

/// Two pixels: a surface, and the background.
HostGBuffer two_pixels(bool is_reversed) {
    HostGBuffer gbuffer;
    const auto image = [](unsigned channels, std::vector<float> values) {
        HostImage made({2, 1}, channels);
        made.values = std::move(values);
        return made;
    };
    gbuffer.exposure_ev = 1;
    gbuffer.camera.depth = {0.1f, 100.0f, is_reversed ? 0.0f : 1.0f, is_reversed ? 1.0f : 0.0f};
    gbuffer.depth = image(1, is_reversed ? std::vector{0.25f, 0.0f} : std::vector{0.75f, 1.0f});
    gbuffer.normal = image(4, {0, 1, 0, 0.5f, 9, 9, 9, 9});
    gbuffer.base_color = image(4, {0.1f, 0.2f, 0.3f, 1, 9, 9, 9, 9});
    gbuffer.emission = image(4, {0.25f, 0, 0, 1, 9, 9, 9, 9});
    gbuffer.motion = image(2, {0.1f, -0.05f, 9, 9});
    gbuffer.material_id = image(1, {3, 0});
    gbuffer.lit = image(4, {0.125f, 0, 0, 1, 0, 0.5f, 0, 1});
    return gbuffer;
}

/// Pixel `x` of the picture in a column and row.
glm::vec3 shown(const HostImage& sheet, unsigned column, unsigned row, unsigned x) {
    return sheet.rgb(size_t(row * (1 + 4 + 14) + 14) * sheet.extent.x + column * (2 + 4) + x);
}

void expect_codes(glm::vec3 linear, glm::vec3 codes, const char* what) {
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(srgb_from_linear(linear[c]), codes[c], 1e-5) << what;
}

TEST(GBufferSheet, ShowsEachImage) {
    for (const bool is_reversed : {false, true}) {
        const HostImage sheet = gbuffer_sheet(two_pixels(is_reversed));
        ASSERT_EQ(sheet.extent, glm::uvec2(3 * 6 - 4, 3 * 19 - 4));
        EXPECT_EQ(shown(sheet, 0, 0, 0), glm::vec3(0.25f, 0, 0)) << "light, times 2";
        EXPECT_EQ(shown(sheet, 0, 0, 1), glm::vec3(0, 1, 0)) << "the background's light";
        EXPECT_EQ(shown(sheet, 1, 0, 0), glm::vec3(0.1f, 0.2f, 0.3f)) << "base colour";
        EXPECT_EQ(shown(sheet, 2, 0, 0), glm::vec3(0.5f, 0, 0)) << "emission, times 2";
        expect_codes(shown(sheet, 0, 1, 0), glm::vec3(1), "the nearest surface");
        expect_codes(shown(sheet, 1, 1, 0), {0.5f, 1, 0.5f}, "normal");
        expect_codes(shown(sheet, 0, 2, 0), glm::vec3(0.5f), "roughness");
        expect_codes(shown(sheet, 1, 2, 0), glm::vec3(1), "metalness");
        expect_codes(shown(sheet, 2, 2, 0), {1, 0.25f, 0.5f}, "motion");
        for (const auto& [column, row] :
             {std::pair{1u, 0u}, {2u, 0u}, {0u, 1u}, {1u, 1u}, {2u, 1u}, {0u, 2u}, {1u, 2u}, {2u, 2u}})
            EXPECT_EQ(shown(sheet, column, row, 1), glm::vec3(0))
                << "no surface in column " << column << ", row " << row;
    }
}

TEST(GBufferSheet, IsSmallAndLabelled) {
    HostGBuffer gbuffer = two_pixels(false);
    const glm::uvec2 extent{700, 300};
    for (HostImage* image : {&gbuffer.depth, &gbuffer.normal, &gbuffer.base_color, &gbuffer.emission, &gbuffer.motion,
                             &gbuffer.material_id, &gbuffer.lit})
        *image = HostImage(extent, image->channels, 0.5f);
    const HostImage sheet = gbuffer_sheet(gbuffer);
    EXPECT_EQ(sheet.extent, glm::uvec2(3 * (234 + 4) - 4, 3 * (100 + 4 + 14) - 4)) << "a third of 700 x 300";
    // The first label's first letter, an L of 6 x 10 pixels, 2 from the corner: its stem, its foot, and white beside.
    const auto is_ink = [&](unsigned x, unsigned y) {
        return sheet.rgb(size_t(y) * sheet.extent.x + x) == glm::vec3(0);
    };
    for (unsigned y = 0; y < 10; ++y) EXPECT_TRUE(is_ink(2, 2 + y) && is_ink(3, 2 + y)) << y;
    for (unsigned x = 0; x < 6; ++x) EXPECT_TRUE(is_ink(2 + x, 11)) << x;
    EXPECT_FALSE(is_ink(5, 5) || is_ink(8, 11));
}

}  // namespace
