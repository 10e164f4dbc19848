#include "tests/variants/diligent_frames.h"
#include "tests/variants/technique_fixture.h"

#include <cmath>
#include <random>

namespace {

/// Surfaces that reflect, of roughness 0, half way between the planes.
HostGBuffer mirrors(glm::uvec2 extent, bool is_reversed = false) {
    HostGBuffer gbuffer;
    gbuffer.camera.extent = {extent, 1.0f / glm::vec2(extent)};
    gbuffer.camera.depth = {0.1f, 100.0f, is_reversed ? 0.0f : 1.0f, is_reversed};
    gbuffer.depth = HostImage(extent, 1, 0.5f);
    gbuffer.normal = HostImage(extent, 4);
    gbuffer.base_color = gbuffer.emission = HostImage(extent, 4, 1.0f);
    return gbuffer;
}

/// Pixels that have each their own kind: background, too near to the far plane, without specular term, dielectric and
/// metal; of roughness around the default threshold of 0.2.
HostGBuffer patchwork(glm::uvec2 extent, bool is_reversed) {
    HostGBuffer gbuffer = mirrors(extent, is_reversed);
    std::mt19937 random(3);
    for (unsigned y = 0; y < extent.y; ++y)
        for (unsigned x = 0; x < extent.x; ++x) {
            const unsigned kind = random() % 6;
            const float from_far_plane[] = {0.0f, 0.9e-6f, 1.1e-6f, 0.5f, 0.5f, 0.5f};
            *gbuffer.depth.pixel(x, y) = is_reversed ? from_far_plane[kind] : 1.0f - from_far_plane[kind];
            gbuffer.base_color.pixel(x, y)[3] = kind == 4;
            gbuffer.emission.pixel(x, y)[3] = kind == 3 ? 0.0f : 0.5f;
            gbuffer.normal.pixel(x, y)[3] = 0.4f * float(random() % 1000) / 1000;
        }
    return gbuffer;
}

bool is_empty(float depth, bool is_reversed) { return is_reversed ? depth < 1e-6f : depth >= 1.0f - 1e-6f; }

/// As the original's buffer of 8 bits holds it.
float rounded(float roughness) { return std::round(roughness * 255.0f) * (1.0f / 255.0f); }

/// What the rules keep, pixel by pixel, and the roughness that they extract; 0 elsewhere.
struct Expected {
    HostImage kept, roughness;
};
Expected expected_mask(const HostGBuffer& gbuffer, float threshold, bool is_float) {
    Expected expected{HostImage(gbuffer.extent(), 1), HostImage(gbuffer.extent(), 1)};
    for (unsigned y = 0; y < gbuffer.extent().y; ++y)
        for (unsigned x = 0; x < gbuffer.extent().x; ++x) {
            const float exact = gbuffer.normal.pixel(x, y)[3], roughness = is_float ? exact : rounded(exact);
            const bool has_specular = gbuffer.base_color.pixel(x, y)[3] > 0 || gbuffer.emission.pixel(x, y)[3] > 0;
            if (is_empty(*gbuffer.depth.pixel(x, y), gbuffer.camera.depth.w == 1) || !has_specular ||
                roughness > threshold)
                continue;
            *expected.kept.pixel(x, y) = 1;
            *expected.roughness.pixel(x, y) = roughness;
        }
    return expected;
}

/// The half-resolution mask from the roughness that a frame left in its target.
HostImage expected_half(const HostGBuffer& gbuffer, const HostImage& roughness, float threshold) {
    const glm::uvec2 extent = gbuffer.extent();
    const bool is_reversed = gbuffer.camera.depth.w == 1;
    HostImage kept(max(extent / 2u, 1u), 1);
    for (unsigned y = 0; y < kept.extent.y; ++y)
        for (unsigned x = 0; x < kept.extent.x; ++x) {
            bool any_surface = false, all_smooth = true;
            for (unsigned row = 2 * y; row < std::min(2 * y + 2 + extent.y % 2, extent.y); ++row)
                for (unsigned column = 2 * x; column < std::min(2 * x + 2 + extent.x % 2, extent.x); ++column) {
                    any_surface |= !is_empty(*gbuffer.depth.pixel(column, row), is_reversed);
                    all_smooth &= *roughness.pixel(column, row) <= threshold;
                }
            *kept.pixel(x, y) = any_surface && all_smooth;
        }
    return kept;
}

struct DiligentMasks : TechniqueTest {
    /// One pixel of that roughness: is it kept?
    bool is_kept(float roughness, const nlohmann::json& parameters) {
        HostGBuffer gbuffer = mirrors({1, 1});
        gbuffer.normal.values[3] = roughness;
        DiligentFrames frames(device(), {1, 1}, parameters);
        frames.begin(gbuffer);
        return frames.kept(frames.mask().full).values[0] == 1;
    }
};

TEST_F(DiligentMasks, KeepWhatTheRulesSayInBothForms) {
    for (const glm::uvec2 extent : {glm::uvec2(96, 64), glm::uvec2(101, 59), glm::uvec2(1, 1), glm::uvec2(1, 6)})
        for (const bool is_reversed : {false, true})
            for (const char* form : {"depth", "stencil"})
                for (const bool is_float : {false, true}) {
                    SCOPED_TRACE(testing::Message() << extent.x << "x" << extent.y << ", reversed " << is_reversed
                                                    << ", " << form << ", float " << is_float);
                    const HostGBuffer gbuffer = patchwork(extent, is_reversed);
                    DiligentFrames frames(device(), extent, {{"mask", form}, {"float_roughness", is_float}});
                    frames.begin(gbuffer);
                    const DiligentMask mask = frames.mask();
                    const Expected expected = expected_mask(gbuffer, 0.2f, is_float);
                    EXPECT_EQ(frames.kept(mask.full).values, expected.kept.values);
                    EXPECT_EQ(frames.kept(mask.traced).values, expected.kept.values);
                    const HostImage roughness = frames.pass_list.download(mask.roughness);
                    for (size_t i = 0; i < roughness.values.size(); ++i)  // codes, not their values, are stored
                        ASSERT_EQ(is_float ? roughness.values[i] : rounded(roughness.values[i]),
                                  expected.roughness.values[i]);
                }
}

/// 51/255 is 0.2, but for the rounding of floats; the original rejects it.
TEST_F(DiligentMasks, CompareTheThresholdWithRoughnessOfEightBits) {
    EXPECT_FALSE(is_kept(0.2f, {{"roughness_threshold", 0.2}}));
    EXPECT_TRUE(is_kept(0.2f, {{"roughness_threshold", 0.2}, {"float_roughness", true}}));
    EXPECT_TRUE(is_kept(50.4f / 255, {{"roughness_threshold", 50.2 / 255}}));  // rounds down to 50/255
    EXPECT_FALSE(is_kept(50.4f / 255, {{"roughness_threshold", 50.2 / 255}, {"float_roughness", true}}));
    EXPECT_TRUE(is_kept(1.0f, {{"roughness_threshold", 1.0}}));
    EXPECT_TRUE(is_kept(0.0f, {{"roughness_threshold", 0.0}}));
}

/// What leaves the whole technique out must agree with what the mask keeps.
TEST_F(DiligentMasks, WouldKeepNothingWhereTheTechniqueIsLeftOut) {
    for (const float roughness : {0.19f, 0.2f, 50.4f / 255, 50.6f / 255, 0.21f})
        for (const bool is_float : {false, true})
            for (const double threshold : {0.2, 50.2 / 255}) {
                const nlohmann::json parameters = {{"roughness_threshold", threshold}, {"float_roughness", is_float}};
                const SceneFacts facts{.has_reflective = true,
                                       .min_roughness = roughness,
                                       .max_roughness = roughness,
                                       .camera_moves = true,
                                       .has_environment = true};
                EXPECT_EQ(make_technique("diligent_ssr", parameters)->leave_out(facts).empty(),
                          is_kept(roughness, parameters))
                    << roughness << ", float " << is_float << ", threshold " << threshold;
            }
}

/// Two frames of which the second keeps other pixels.
struct DiligentStaleRoughness : DiligentMasks {
    const HostGBuffer first = patchwork({31, 17}, false);
    HostGBuffer second = first;

    DiligentStaleRoughness() {
        for (size_t i = 3; i < second.normal.values.size(); i += 4)
            second.normal.values[i] = 0.4f - second.normal.values[i];
    }
    HostImage roughness_after_both(bool is_cleared) {
        DiligentFrames frames(device(), first.extent(), {{"clear_targets", is_cleared}, {"float_roughness", true}});
        frames.begin(first);
        frames.mask();
        frames.begin(second);
        return frames.pass_list.download(frames.mask().roughness);
    }
};

TEST_F(DiligentStaleRoughness, IsWhatOlderFramesLeft) {
    const Expected before = expected_mask(first, 0.2f, true), now = expected_mask(second, 0.2f, true);
    const HostImage found = roughness_after_both(false);
    for (size_t i = 0; i < found.values.size(); ++i)
        EXPECT_EQ(found.values[i], now.kept.values[i] > 0 ? now.roughness.values[i] : before.roughness.values[i]) << i;
}

TEST_F(DiligentStaleRoughness, IsOneIfTargetsAreCleared) {
    const Expected now = expected_mask(second, 0.2f, true);
    const HostImage found = roughness_after_both(true);
    for (size_t i = 0; i < found.values.size(); ++i)
        EXPECT_EQ(found.values[i], now.kept.values[i] > 0 ? now.roughness.values[i] : 1.0f) << i;
}

TEST_F(DiligentMasks, OfHalfResolutionKeepWhatTheRulesSayInBothForms) {
    for (const glm::uvec2 extent : {glm::uvec2(96, 64), glm::uvec2(101, 59), glm::uvec2(64, 33), glm::uvec2(1, 1)})
        for (const bool is_reversed : {false, true})
            for (const char* form : {"depth", "stencil"})
                for (const bool is_cleared : {false, true}) {
                    SCOPED_TRACE(testing::Message() << extent.x << "x" << extent.y << ", reversed " << is_reversed
                                                    << ", " << form << ", cleared " << is_cleared);
                    const HostGBuffer gbuffer = patchwork(extent, is_reversed);
                    DiligentFrames frames(device(), extent,
                                          {{"mask", form}, {"half_resolution", true}, {"clear_targets", is_cleared}});
                    frames.begin(gbuffer);
                    const DiligentMask mask = frames.mask();
                    const HostImage roughness = frames.pass_list.download(mask.roughness);
                    EXPECT_EQ(frames.kept(mask.traced).values, expected_half(gbuffer, roughness, 0.2f).values);
                    EXPECT_EQ(frames.kept(mask.full).values, expected_mask(gbuffer, 0.2f, false).kept.values);
                }
}

/// Rough pixels leave 0 in the original's roughness, by which they count as mirrors.
TEST_F(DiligentMasks, OfHalfResolutionTraceRoughSurfacesUnlessTargetsAreCleared) {
    HostGBuffer gbuffer = mirrors({8, 8});
    for (unsigned y = 0; y < 8; ++y)
        for (unsigned x = 0; x < 8; ++x)
            if (x > 2) gbuffer.normal.pixel(x, y)[3] = 0.9f;
    for (const bool is_cleared : {false, true}) {
        DiligentFrames frames(device(), {8, 8}, {{"half_resolution", true}, {"clear_targets", is_cleared}});
        frames.begin(gbuffer);
        const HostImage kept = frames.kept(frames.mask().traced);
        for (unsigned x = 0; x < 4; ++x) EXPECT_EQ(*kept.pixel(x, 1), is_cleared ? x < 1 : true) << x;
    }
}

struct DiligentMaskOf : TechniqueTest, testing::WithParamInterface<std::string> {};

TEST_P(DiligentMaskOf, EqualsTheOriginals) {
    const HostGBuffer gbuffer = diligent_golden_gbuffer(GetParam());
    for (const char* form : {"depth", "stencil"})
        for (const double threshold : {0.2, 0.65}) {
            const std::string file = GetParam() + (threshold < 0.5 ? "/mask_rthr0.2.exr" : "/mask_rthr0.65.exr");
            const LayeredImage golden = read_golden(file);
            DiligentFrames frames(device(), gbuffer.extent(), {{"mask", form}, {"roughness_threshold", threshold}});
            frames.begin(gbuffer);
            const DiligentMask mask = frames.mask();
            EXPECT_EQ(frames.kept(mask.full).values, golden_layer(golden, "mask").values) << form << ", " << file;
            EXPECT_EQ(frames.pass_list.download(mask.roughness).values, golden_layer(golden, "rough").values)
                << form << ", " << file;
        }
}

INSTANTIATE_TEST_SUITE_P(golden_diligent_mask, DiligentMaskOf,
                         testing::ValuesIn(diligent_sets_with("mask_rthr0.2.exr")),
                         [](const auto& info) { return golden_test_name(info.param); });

struct DiligentMasksOf : TechniqueTest, testing::WithParamInterface<std::string> {};

/// With the roughness that older frames left where the mask leaves out.
TEST_P(DiligentMasksOf, EqualTheOriginals) {
    const glm::uvec2 extent = diligent_golden_frame(GetParam(), 0).extent();
    DiligentFrames frames(device(), extent, diligent_sequence_parameters(GetParam()));
    for (unsigned frame = 0; frame < diligent_frame_count(GetParam()); ++frame) {
        frames.begin(diligent_golden_frame(GetParam(), frame));
        const DiligentMask mask = frames.mask();
        const LayeredImage golden = read_golden(diligent_frame_folder(GetParam(), frame) + "aux.exr");
        EXPECT_EQ(frames.kept(mask.full).values, golden_layer(golden, "mask").values) << frame;
        EXPECT_EQ(frames.pass_list.download(mask.roughness).values, golden_layer(golden, "rough").values) << frame;
    }
}

INSTANTIATE_TEST_SUITE_P(golden_diligent_masks, DiligentMasksOf, testing::ValuesIn(diligent_sets_with("f0/aux.exr")),
                         [](const auto& info) { return golden_test_name(info.param); });

}  // namespace
