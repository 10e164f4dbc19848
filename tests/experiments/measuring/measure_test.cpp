#include "experiments/measuring/measure.h"

#include <gtest/gtest.h>
#include <cmath>

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
