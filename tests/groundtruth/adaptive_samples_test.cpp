// Samples for the pixels that decide the noise of an MSE: their number, what they gain, and that they bring no bias.
#include "groundtruth/reference/adaptive_samples.h"

#include "groundtruth/reference/reference_guide.h"
#include "groundtruth/reference/reference_stopping.h"
#include "groundtruth/sampling/sobol.h"

#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>
#include <numeric>

namespace {

constexpr glm::uvec2 extent(64, 32);
constexpr uint64_t uniform = 128;

double sum_of(const HostImage& image) { return std::accumulate(image.values.begin(), image.values.end(), 0.0); }

/// A block of 4x4 pixels, 1 of 128, with `ratio` times the standard deviation of all others.
HostImage block_of_noise(float ratio) {
    HostImage variance(extent, 3, 1.0f);
    for (unsigned y = 8; y < 12; ++y)
        for (unsigned x = 8; x < 12; ++x) variance.set_rgb(y * extent.x + x, glm::vec3(ratio * ratio));
    return variance;
}

double sum_of_variances(const HostImage& variance, const HostImage& extra) {
    double sum = 0;
    for (size_t i = 0; i < extra.values.size(); ++i)
        sum += double(variance.rgb(i).x) / (double(uniform) + double(extra.values[i]));
    return sum;
}

}  // namespace

TEST(AdaptiveSamples, SpendWhatTheyMayInBatchesOfPowersOfTwo) {
    HostImage materials(extent, 1, 1.0f);
    for (unsigned x = 0; x < extent.x; ++x) *materials.pixel(x, 0) = 0;  // the sky
    const auto surfaces = double(extent.x * (extent.y - 1));
    for (const double share : {0.125, 0.25, 1.0}) {
        const HostImage extra = adaptive_samples(block_of_noise(20), materials, uniform, share);
        // 16 pixels differ alike: where they take one step of a factor of two, most of the budget moves.
        EXPECT_LE(sum_of(extra), share * double(uniform) * surfaces);
        EXPECT_GT(sum_of(extra), 0.4 * share * double(uniform) * surfaces);
        for (unsigned x = 0; x < extent.x; ++x) EXPECT_EQ(*extra.pixel(x, 0), 0);
        for (const float samples : extra.values)
            EXPECT_TRUE(samples == 0 || std::exp2(std::round(std::log2(samples / 16))) * 16 == samples) << samples;
    }
}

TEST(AdaptiveSamples, LeaveAsLittleNoiseAsNeymansShares) {
    // With all samples free the sum of the variances is (sum of deviations)^2 / samples at least. A floor of `uniform`
    // samples, windows that smooth the block's edge, and powers of two cost a factor of less than 2 together.
    const HostImage materials(extent, 1, 1.0f);
    for (const float ratio : {20.0f, 100.0f}) {
        const HostImage variance = block_of_noise(ratio), extra = adaptive_samples(variance, materials, uniform, 0.5);
        const double pixels = extent.x * extent.y, block = 16, samples = double(uniform) * pixels + sum_of(extra),
                     least = std::pow(pixels - block + block * double(ratio), 2) / samples,
                     of_equal_counts = (pixels - block + block * double(ratio) * double(ratio)) * pixels / samples,
                     left = sum_of_variances(variance, extra);
        EXPECT_LT(left, 2 * least) << ratio;
        EXPECT_LT(left, 0.6 * of_equal_counts) << ratio;  // Neyman: 0.32 and 0.04 at best
    }
}

TEST(AdaptiveSamples, AreAlikeForPixelsThatAreAlike) {
    const HostImage materials(extent, 1, 1.0f);
    const HostImage alike = adaptive_samples(HostImage(extent, 3, 1.0f), materials, uniform, 0.25);
    EXPECT_TRUE(std::ranges::all_of(alike.values, [](float samples) { return samples == 32; }));
    EXPECT_EQ(sum_of(adaptive_samples(HostImage(extent, 3, 0.0f), materials, uniform, 1)), 0) << "no noise";
    const HostImage sky(extent, 1, 0.0f);
    EXPECT_EQ(sum_of(adaptive_samples(HostImage(extent, 3, 1.0f), sky, uniform, 1)), 0) << "no surface";
}

TEST(AdaptiveSamples, AreNoMoreThanCountsHoldExactly) {
    const HostImage materials(extent, 1, 1.0f),
        extra = adaptive_samples(block_of_noise(1000), materials, max_sample_limit / 2, 8);
    EXPECT_EQ(std::ranges::max(extra.values), float(max_sample_limit / 2));
}

TEST(AdaptiveSamples, BringNoBias) {
    // One path in 200 carries half of the light of a pixel, whose mean is 1; the guide of 64 paths sees none in 3 of 4
    // pixels. If a pixel's own samples decided, those that met bright paths would get more, which are then diluted: the
    // mean would be too small by 6 %. 6 standard errors: a false alarm in 5e8.
    constexpr double rate = 1.0 / 200, bright = 0.5 / rate;
    const PixelTracer tracer = {
        .first_hit = [](unsigned, unsigned) { return FirstHit{.is_hit = true, .material = 0}; },
        .trace =
            [](unsigned x, unsigned y, const FirstHit&, unsigned, unsigned count, std::span<SampleBatch> batches) {
                for (auto& [seed, estimate] : batches) {
                    for (unsigned sample = 0; sample < count; ++sample) {
                        const uint64_t bits =
                            hash_bits_64(seed ^ hash_bits_64(uint64_t(y) << 40 | uint64_t(x) << 20 | sample));
                        estimate.specular += glm::dvec3(0.5 + (double(bits) * 0x1p-64 < rate ? bright : 0.0));
                    }
                    estimate.samples += count;
                }
            }};
    double sum = 0, variance = 0, extra = 0, pixels = 0;
    for (unsigned seed = 1; seed <= 24; ++seed) {
        const ReferenceRun run;
        const ReferenceSettings settings{.max_samples = uniform, .adaptive_share = 0.5f, .seed = seed};
        ReferenceState state = empty_state(extent, settings);
        RenderedGuide guide = render_guide(tracer, extent, 64, run);
        state.reference.guide = std::move(guide.means);
        state.guide_variance = std::move(guide.specular_variance);
        RenderClock clock{.run = run};
        render_until_limits(state, tracer, clock);
        for (size_t i = 0; i < state.reference.sample_count.values.size(); ++i) {
            const double samples = state.reference.sample_count.values[i];
            sum += double(state.reference.specular.mean.rgb(i).x) - 1;
            variance += rate * (1 - rate) * bright * bright / samples;
            extra += samples - double(uniform), ++pixels;
        }
    }
    EXPECT_GT(extra, 0.3 * uniform * pixels);  // of 0.5: the rule was at work; rounding to powers of two leaves a part
    EXPECT_LT(std::abs(sum), 6 * std::sqrt(variance)) << sum / pixels << " +- " << std::sqrt(variance) / pixels;
}
