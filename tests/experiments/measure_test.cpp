#include "experiments/measure.h"

#include <gtest/gtest.h>

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
    for (HostImage* image : {&reference.depth, &reference.material_id}) *image = HostImage({16, 16}, 1);
    reference.normal = HostImage({16, 16}, 3);
    Config config;
    config.targets = {"image"}, config.metrics = {"mse"};
    const PoseTruth truth = pose_truth(reference, config, 0.0f, {.has_targets = true});
    const CompositedImages perfect{reference.specular.mean, reference.incident.mean, HostImage({16, 16}, 1, 1.0f)};
    EXPECT_EQ(composited_image(truth, perfect).values, reference.image.mean.values);
    EXPECT_EQ(truth.targets.at("image").image.values, reference.image.mean.values);
    EXPECT_EQ(truth.diffuse.values, reference.diffuse.mean.values) << "the lit colour has no highlights";
}
