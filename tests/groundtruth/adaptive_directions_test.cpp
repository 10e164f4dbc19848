// Directions for the pixels that decide the noise: their number, what they gain, and that they bring no bias.
#include "groundtruth/reference/adaptive_directions.h"

#include "groundtruth/reference/reference_guide.h"
#include "groundtruth/reference/reference_stopping.h"
#include "groundtruth/sampling/sobol.h"

#include <gtest/gtest.h>
#include <algorithm>
#include <bit>
#include <cmath>

namespace {

constexpr glm::uvec2 extent(64, 32);
constexpr double pixels = extent.x * extent.y, block = 16;

/// As bright as 1, each lobe with a variance of 1; a block of 4x4 pixels, 1 of 128, has `ratio` times the specular
/// standard deviation of all others.
RenderedGuide guide_with_block(float ratio) {
    RenderedGuide guide{.means = {},
                        .specular_variance = HostImage(extent, 3, 1.0f),
                        .diffuse_variance = HostImage(extent, 3, 1.0f),
                        .image = HostImage(extent, 3, 1.0f),
                        .material_id = HostImage(extent, 1, 1.0f)};
    for (unsigned y = 8; y < 12; ++y)
        for (unsigned x = 8; x < 12; ++x) guide.specular_variance.set_rgb(y * extent.x + x, glm::vec3(ratio * ratio));
    return guide;
}

double added(const HostImage& directions) {
    double sum = 0;
    for (const float d : directions.values) sum += double(d) - 1;
    return sum;
}

}  // namespace

TEST(AdaptiveDirections, SpendWhatTheyMayInPowersOfTwo) {
    RenderedGuide guide = guide_with_block(20);
    for (unsigned x = 0; x < extent.x; ++x) *guide.material_id.pixel(x, 0) = 0;  // the sky
    for (const bool for_image : {false, true})
        for (const double share : {0.125, 0.25, 2.0}) {
            const HostImage directions = adaptive_directions(guide, share, for_image);
            const double budget = share * double(extent.x * (extent.y - 1)) * (for_image ? 2 : 1);
            // 16 pixels differ alike: where they take one step of a factor of two, most of the budget moves.
            EXPECT_LE(added(directions), budget);
            EXPECT_GT(added(directions), 0.4 * budget);
            for (unsigned i = 0; i < 2 * extent.x; ++i) EXPECT_EQ(directions.values[i], 1);
            for (const float d : directions.values) EXPECT_TRUE(std::has_single_bit(unsigned(d)) && d <= 64) << d;
        }
}

TEST(AdaptiveDirections, LeaveAsLittleNoiseAsNeymansShares) {
    // With all directions free the sum of the variances is (sum of deviations)^2 / directions at least. A floor of one,
    // windows that smooth the block's edge, and powers of two cost a factor of less than 2 together.
    for (const float ratio : {20.0f, 100.0f}) {
        const RenderedGuide guide = guide_with_block(ratio);
        const HostImage directions = adaptive_directions(guide, 0.5, false);
        const double all = pixels + added(directions), squares = double(ratio) * double(ratio),
                     least = std::pow(pixels - block + block * double(ratio), 2) / all,
                     of_equal = (pixels - block + block * squares) * pixels / all;
        double left = 0;
        for (size_t i = 0; i < directions.pixel_count(); ++i) {
            EXPECT_EQ(directions.values[2 * i], 1) << "no diffuse direction for an MSE of the specular light";
            left += double(guide.specular_variance.rgb(i).x) / double(directions.values[2 * i + 1]);
        }
        EXPECT_LT(left, 2 * least) << ratio;
        EXPECT_LT(left, 0.6 * of_equal) << ratio;  // Neyman: 0.32 and 0.04 at best
    }
}

TEST(AdaptiveDirections, OfAnImageFollowBothLobesAndItsBrightness) {
    RenderedGuide guide = guide_with_block(1);
    for (size_t i = 0; i < pixels / 2; ++i) guide.diffuse_variance.set_rgb(i, glm::vec3(64));  // the upper half
    const HostImage directions = adaptive_directions(guide, 3.5, true);
    // Deviations of 8 : 1, the mean being 1 + 3.5 of 1 + 7: steps of two give 8 : 1. Windows blur the border.
    EXPECT_EQ(directions.values[0], 8);
    EXPECT_EQ(directions.values[1], 1);
    EXPECT_EQ(directions.values[2 * size_t(pixels) - 2], 1);

    // Where deviations are as bright as the image, none gets more; a factor of all light changes nothing.
    RenderedGuide uneven = guide_with_block(1);
    for (size_t i = 0; i < pixels; ++i) {
        const float brightness = i % 7 ? 1.0f : 4.0f;
        uneven.image.set_rgb(i, glm::vec3(brightness));
        for (HostImage* variance : {&uneven.specular_variance, &uneven.diffuse_variance})
            variance->set_rgb(i, glm::vec3(brightness * brightness));
    }
    EXPECT_EQ(added(adaptive_directions(uneven, 0.9, true)), 0);
    for (HostImage* variance : {&guide.specular_variance, &guide.diffuse_variance})
        for (float& v : variance->values) v *= 1024.0f * 1024;
    for (float& v : guide.image.values) v *= 1024;
    EXPECT_EQ(adaptive_directions(guide, 3.5, true).values, directions.values);
}

TEST(AdaptiveDirections, AreAlikeForPixelsThatAreAlike) {
    const HostImage alike = adaptive_directions(guide_with_block(1), 1, true);
    EXPECT_TRUE(std::ranges::all_of(alike.values, [](float d) { return d == 2; }));
    RenderedGuide guide = guide_with_block(1);
    guide.specular_variance = HostImage(extent, 3, 0.0f);
    EXPECT_EQ(added(adaptive_directions(guide, 1, false)), 0) << "no noise";
    guide = guide_with_block(20);
    guide.image = HostImage(extent, 3, 0.0f);
    EXPECT_GT(added(adaptive_directions(guide, 1, true)), 0) << "black";
    guide.specular_variance.values[100] = HUGE_VALF;
    EXPECT_EQ(added(adaptive_directions(guide, 1, true)), 0) << "a variance beyond float";
    guide = guide_with_block(20);
    guide.material_id = HostImage(extent, 1, 0.0f);
    EXPECT_EQ(added(adaptive_directions(guide, 1, true)), 0) << "no surface";
}

TEST(AdaptiveDirections, BringNoBias) {
    // One path in 200 carries half of the light of a pixel, whose mean is 1; the guide of 64 paths sees none in 3 of 4
    // pixels. If a pixel's own samples decided, those that met bright paths would get more, which are then diluted: the
    // mean would be too small by 6 %. 6 standard errors: a false alarm in 5e8.
    constexpr double rate = 1.0 / 200, bright = 0.5 / rate;
    constexpr unsigned samples = 128;
    const PixelTracer tracer = {
        .first_hit = [](unsigned, unsigned) { return FirstHit{.is_hit = true, .material = 0}; },
        .trace =
            [](unsigned x, unsigned y, const FirstHit&, unsigned, unsigned count, std::span<SampleBatch> batches,
               Directions directions) {
                for (auto& [seed, estimate] : batches) {
                    for (unsigned i = 0; i < count * directions.specular; ++i) {
                        const uint64_t bits =
                            hash_bits_64(seed ^ hash_bits_64(uint64_t(y) << 40 | uint64_t(x) << 20 | i));
                        const double radiance = 0.5 + (double(bits) * 0x1p-64 < rate ? bright : 0.0);
                        estimate.specular += glm::dvec3(radiance / directions.specular);
                    }
                    estimate.samples += count;
                }
            }};
    double sum = 0, variance = 0, more = 0;
    constexpr unsigned seeds = 24;
    for (unsigned seed = 1; seed <= seeds; ++seed) {
        const ReferenceRun run;
        const ReferenceSettings settings{.max_samples = samples, .adaptive_share = 0.5f, .seed = seed};
        ReferenceState state = empty_state(extent, settings);
        RenderedGuide guide = render_guide(tracer, extent, 64, run);
        state.reference.directions = adaptive_directions(guide, 0.5, false);
        state.reference.guide = std::move(guide.means);
        RenderClock clock{.run = run};
        render_until_limits(state, tracer, clock);
        for (size_t i = 0; i < state.reference.directions.pixel_count(); ++i) {
            sum += double(state.reference.specular.mean.rgb(i).x) - 1;
            variance +=
                rate * (1 - rate) * bright * bright / (samples * double(state.reference.directions.values[2 * i + 1]));
        }
        more += added(state.reference.directions);
    }
    EXPECT_GT(more, 0.3 * pixels * seeds);  // of 0.5: the rule was at work; rounding to powers of two leaves a part
    EXPECT_LT(std::abs(sum), 6 * std::sqrt(variance))
        << sum / (pixels * seeds) << " +- " << std::sqrt(variance) / (pixels * seeds);
}
