// Effects hold the noise of the reference that both of their errors are made with.
#include "experiments/effects.h"
#include "experiments/interval.h"

#include <gtest/gtest.h>
#include <algorithm>
#include <random>

namespace {

/// Two points of `seeds` seeds each against a reference of noisy halves, of 600 pixels, of which one has most of the
/// noise; as play_point() measures them. Without seeds the points have no scatter.
EffectRow simulated_effect(std::mt19937& random, unsigned seeds, bool has_noise) {
    const glm::uvec2 extent(30, 20);
    std::normal_distribution<float> normal;
    ReferenceHalves halves{.a = HostImage(extent, 3),
                           .b = HostImage(extent, 3),
                           .variance = HostImage(extent, 3),
                           .guide = HostImage(extent, 3, 2.0f),
                           .samples = 16};
    HostImage mean(extent, 3);
    for (size_t i = 0; i < mean.values.size(); ++i) {
        const float deviation = i / 3 == 17 ? 3.0f : 0.4f;
        halves.a.values[i] = 2 + deviation * normal(random), halves.b.values[i] = 2 + deviation * normal(random);
        mean.values[i] = (halves.a.values[i] + halves.b.values[i]) / 2;
        halves.variance.values[i] = deviation * deviation / 2;
    }
    const MetricReference reference = metric_reference(mean, halves, {"mse"}, {});
    const std::vector<Mask> masks = {full_mask(extent)};
    std::vector<ResultRow> rows;
    std::vector<ReferenceNoise> noise;
    for (const auto& [point, bias] : {std::pair("base", 0.5f), std::pair("better", 0.4f)}) {
        ReferenceNoiseMeans means;
        for (unsigned seed = 0; seed < std::max(seeds, 1u); ++seed) {
            HostImage image(extent, 3);
            // Both err alike in a part, so that most of the reference's noise is common to them.
            for (size_t i = 0; i < image.values.size(); ++i)
                image.values[i] = 2 + (i % 2 ? bias : -0.45f) + (seeds ? 0.3f * normal(random) : 0.0f);
            const Score s = score(reference, image, masks).at(0);
            rows.push_back({.shot = "s",
                            .frame = "0",
                            .variant = "v",
                            .point = point,
                            .seed = seed,
                            .target = "specular",
                            .metric = "mse",
                            .formula = "mse",
                            .mask = masks[0].name,
                            .value = s.value});
            means.add("0", "specular", reference, image, masks);
        }
        for (ReferenceNoise& n : means.means({.shot = "s", .variant = "v", .point = point})) noise.push_back(n);
    }
    const std::vector<VariantConfig> variants = {
        {.variant = "v", .point = "base", .depends_on_seed = seeds > 0, .is_baseline = true},
        {.variant = "v", .point = "better", .depends_on_seed = seeds > 0}};
    if (!has_noise) noise.clear();
    return paired_effects(rows, variants, {}, noise).at(0);
}

}  // namespace

/// Both errors are those against one reference, whose noise would move their ratio in another run.
TEST(Effects, HoldTheNoiseOfTheReference) {
    std::mt19937 random(11);
    const double halves = 0.45 * 0.45;  // of the values that err alike
    constexpr int studies = 400;
    for (const unsigned seeds : {0u, 4u}) {
        const double variance = seeds ? 0.09 : 0.0;
        const double truth = (0.16 + halves + 2 * variance) / (0.25 + halves + 2 * variance);
        int covered = 0, covered_without = 0;
        for (int study = 0; study < studies; ++study) {
            const EffectRow e = simulated_effect(random, seeds, true);
            ASSERT_TRUE(e.low && e.high) << e.interval;
            EXPECT_EQ(e.interval, seeds ? interval::reference_and_seeds : interval::reference);
            covered += *e.low <= truth && truth <= *e.high;
            if (seeds == 0) continue;
            const EffectRow without = simulated_effect(random, seeds, false);
            covered_without += *without.low <= truth && truth <= *without.high;
        }
        // 95 % of 400 studies, whose count has a deviation of 4.4: four and a half of it below, for a false alarm of
        // 1e-5. Intervals of four seeds, or of one dominant pixel, may cover more.
        EXPECT_GE(covered, 360) << seeds;
        if (seeds) {
            EXPECT_LT(covered_without, covered) << "with the seeds alone they are too narrow";
        }
    }
}
