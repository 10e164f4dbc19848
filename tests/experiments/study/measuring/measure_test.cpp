#include "experiments/study/measuring/frame_means.h"

#include <gtest/gtest.h>
#include <cmath>
#include <random>

namespace {

ResultRow frame_row(const std::string& frame, const std::string& metric, double value) {
    ResultRow row{.shot = "s",
                  .frame = frame,
                  .technique = "v",
                  .point = "p",
                  .target = "specular",
                  .metric = metric,
                  .formula = metric,
                  .mask = "all"};
    row.value = value;
    return row;
}

}  // namespace

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

/// The others would stand for the pixels that a technique leaves undefined: perfect ones for those where it fails.
TEST(Measure, FewPixelsMayBeUndefinedWhereThereIsAValue) {
    PoseTruth truth;
    truth.targets.emplace("specular", metric_reference(HostImage({16, 16}, 3, 1.0f), {}, {"mse"}, {}));
    const auto value = [&](size_t undefined) {
        CompositedImages images{.specular = HostImage({16, 16}, 3, 1.0f),
                                .incident = HostImage({16, 16}, 3),
                                .confidence = HostImage({16, 16}, 1)};
        for (size_t i = 0; i < undefined; ++i) images.specular.set_rgb(i, glm::vec3(NAN));
        return measure_targets(truth, images, std::vector{full_mask({16, 16})}, {}).at(0).value;
    };
    EXPECT_EQ(value(2), 0.0);
    EXPECT_FALSE(value(3)) << "more than a hundredth of 256";
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
    truth.frame_reference = metric_reference(mean, halves, {"flip", "psnr"}, {});
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

TEST(Measure, AveragesOverFrames) {
    std::vector<ResultRow> rows = {frame_row("0", "mse", 1), frame_row("1", "mse", 4), frame_row("0", "bias", 2),
                                   frame_row("1", "bias", 2)};
    rows[0].low = 0.5, rows[0].high = 1.5, rows[0].pixels = 10;
    rows[1].low = 3.0, rows[1].high = 5.0, rows[1].pixels = 20;
    rows[3].value.reset();
    FrameMeans frames;
    for (const ResultRow& r : rows) frames.add({{r}, {noisy_map({4, 4}, 16)}});
    const std::vector<ResultRow> means = frames.rows();
    ASSERT_EQ(means.size(), 2u);
    for (const ResultRow& m : means) {
        EXPECT_EQ(m.frame, over_frames);
        if (m.metric == "bias") {
            EXPECT_FALSE(m.value) << "a frame without a value leaves the mean without one";
            continue;
        }
        EXPECT_EQ(m.value, 2.5);
        EXPECT_EQ(m.pixels, 30u);
    }
}

TEST(Measure, NoiseThatFramesShareAddsUp) {
    // Two frames of 64 pixels whose parts of the value move by 0.5 each: with the same noise their mean moves as one of
    // them, with noises of its own by 1 / sqrt(2) of that, and with opposite ones not at all.
    std::mt19937 random(1);
    const glm::uvec2 extent(8, 8);
    const auto width = [&](int relation) {
        FrameRows frames[2];
        for (FrameRows& frame : frames) {
            frame.rows = {frame_row("0", "mse", 1)};
            frame.noise = {noisy_map(extent, 64)};
            frame.noise[0].variance.values.assign(64, 0.25);
        }
        for (size_t p = 0; p < 64; ++p) {
            frames[0].noise[0].swapped.values[p] = random() % 2 ? 0.5 : -0.5;
            frames[1].noise[0].swapped.values[p] = relation != 0  ? relation * frames[0].noise[0].swapped.values[p]
                                                   : random() % 2 ? 0.5
                                                                  : -0.5;
        }
        FrameMeans means;
        for (const FrameRows& frame : frames) means.add(frame);
        const ResultRow mean = means.rows().at(0);
        return (*mean.high - *mean.low) / 2;
    };
    const double one = 1.9977 * 0.5 * 8;  // Student's t of 64 degrees
    EXPECT_NEAR(width(1), one, 1e-3);
    EXPECT_EQ(width(-1), 0);
    EXPECT_NEAR(width(0), one / std::sqrt(2), 0.25 * one);  // 64 signs: 1/8 of the square, 4 of that
}
