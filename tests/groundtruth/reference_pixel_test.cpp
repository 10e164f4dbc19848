// What a pixel of a reference states of its own error.
#include "groundtruth/reference/reference_passes.h"

#include <gtest/gtest.h>
#include <cmath>
#include <random>

/// Where both parts of a sample are the same uniform number u, D of 16 samples and S of 32, of which 16 are those of D:
/// the variance of D + S is var(u) (1/16 + 1/32 + 2/32).
TEST(ReferencePixels, StateTheVarianceOfAnImageWhosePartsShareSamples) {
    const PixelTracer tracer{.first_hit = [](unsigned, unsigned) { return FirstHit{.is_hit = true}; },
                             .trace =
                                 [](unsigned x, unsigned y, const FirstHit&, unsigned first, unsigned count,
                                    std::span<SampleBatch> batches, Directions directions) {
                                     for (auto& [seed, estimate] : batches) {
                                         std::mt19937_64 random(seed + (uint64_t(y) << 32 | x));
                                         std::uniform_real_distribution<double> uniform;
                                         random.discard(first);
                                         for (unsigned i = 0; i < count; ++i) {
                                             const double u = uniform(random);
                                             if (directions.diffuse > 0) estimate.diffuse += u;
                                             estimate.specular += u;
                                         }
                                     }
                                 }};
    Reference r = empty_state({64, 64}, {}).reference;
    double stated = 0, squares = 0;
    for (unsigned i = 0; i < 64 * 64; ++i) {
        add_samples(r, tracer, i % 64, i / 64, {.seed = 1, .batch_samples = 1, .most_lit = 16});
        add_samples(r, tracer, i % 64, i / 64, {.seed = 1, .batch_samples = 1, .most_lit = 16});
        stated += double(r.image.variance.rgb(i).x) / (64 * 64);
        squares += std::pow(double(r.image.mean.rgb(i).x) - 1.0, 2) / (64 * 64);
    }
    const double sought = 1.0 / 12 * 5 / 32;
    // The variance of 4096 normal numbers has a standard error of 2.2 %, of which the bounds are 4.5; the mean of the
    // stated ones has less.
    EXPECT_NEAR(squares / sought, 1.0, 0.1);
    EXPECT_NEAR(stated / sought, 1.0, 0.1) << "3/5 where what both share is left out";
}
