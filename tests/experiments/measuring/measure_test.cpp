#include "experiments/measuring/frame_means.h"

#include <gtest/gtest.h>
#include <cmath>
#include <random>

TEST(Measure, ImageIsAllLightOfTheTruth) {
    const auto constant = [](float value) {
        const HostImage image({16, 16}, 3, value);
        return ReferenceOutput{image, image, image, HostImage({16, 16}, 3)};
    };
    Reference reference;
    reference.extent = {16, 16};
    reference.diffuse = constant(0.25f), reference.specular = reference.incident = constant(0.5f);
    reference.highlights = HostImage({16, 16}, 3, 1.0f);
    reference.image = constant(1.75f);
    for (HostImage* image : {&reference.depth, &reference.material_id, &reference.sample_count})
        *image = HostImage({16, 16}, 1);
    reference.lobe_samples = HostImage({16, 16}, 2);
    for (HostImage* image : {&reference.guide.specular, &reference.guide.incident, &reference.guide.diffuse})
        *image = HostImage({16, 16}, 3, 0.5f);
    reference.normal = HostImage({16, 16}, 3);
    Config config;
    config.targets = {"image"}, config.metrics = {"mse"};
    const PoseTruth truth = pose_truth(reference, config, 0.0f, {.has_targets = true});
    const CompositedImages perfect{reference.specular.mean, reference.incident.mean, HostImage({16, 16}, 1, 1.0f)};
    EXPECT_EQ(composited_image(truth, perfect).values, reference.image.mean.values);
    EXPECT_EQ(truth.targets.at("image").image.values, reference.image.mean.values);
    EXPECT_EQ(truth.diffuse.values, reference.diffuse.mean.values) << "the lit colour has no highlights";
}

TEST(Measure, ReportsAResultWithoutAnyFinitePixel) {
    PoseTruth truth;
    truth.diffuse = HostImage({16, 16}, 3);
    truth.targets.emplace("specular", metric_reference(HostImage({16, 16}, 3, 1.0f), {}, {"mse", "relmse"}, {}));
    CompositedImages images{.specular = HostImage({16, 16}, 3, NAN),
                            .incident = HostImage({16, 16}, 3),
                            .confidence = HostImage({16, 16}, 1)};
    Mask empty{.name = "empty", .extent = {16, 16}, .inside = std::vector<uint8_t>(256)};
    const auto rows = measure_targets(truth, images, std::vector{full_mask({16, 16}), empty}, {});
    ASSERT_EQ(rows.size(), 2u) << "one for each metric of the full mask, none of the empty one";
    for (const ResultRow& r : rows) {
        EXPECT_FALSE(r.value);
        EXPECT_EQ(r.pixels, 0u);
        EXPECT_EQ(r.non_finite, 256u);
    }
}

/// The noise of two equal frames is one, and no mean of theirs has less.
TEST(Measure, MeansOverFramesOfExtrapolatedErrorsHaveTheirInterval) {
    const glm::uvec2 extent(64, 32);
    std::mt19937 random(4);
    std::normal_distribution<float> normal;
    ReferenceHalves halves{.a = HostImage(extent, 3),
                           .b = HostImage(extent, 3),
                           .variance = HostImage(extent, 3, 0.02f),
                           .guide = HostImage(extent, 3, 0.5f),
                           .samples = 16};
    HostImage mean(extent, 3);
    for (size_t i = 0; i < mean.values.size(); ++i) {
        halves.a.values[i] = 0.5f + 0.2f * normal(random), halves.b.values[i] = 0.5f + 0.2f * normal(random);
        mean.values[i] = (halves.a.values[i] + halves.b.values[i]) / 2;
    }
    PoseTruth truth;
    truth.frame_reference = metric_reference(mean, halves, {"mae", "flip", "psnr"}, {});
    const Mask all = full_mask(extent);
    const FrameRows frame = measure_frame(truth, HostImage(extent, 3, 0.9f), std::span(&all, 1), {.frame = "0"});
    FrameMeans means;
    means.add(frame), means.add(frame);
    for (const ResultRow& row : means.rows()) {
        const auto of_frame = std::ranges::find(frame.rows, row.metric, &ResultRow::metric);
        ASSERT_TRUE(of_frame->low && of_frame->high) << row.metric;
        if (row.metric == "psnr") {
            EXPECT_FALSE(row.low) << "a mean of decibels is no decibels of a mean";
            continue;
        }
        ASSERT_TRUE(row.low && row.high) << row.metric;
        EXPECT_LT(*row.low, *row.value);
        EXPECT_NEAR(*row.low, *of_frame->low, 1e-5 * *row.value) << row.metric;  // sums in float32
        EXPECT_NEAR(*row.high, *of_frame->high, 1e-5 * *row.value) << row.metric;
    }
}
