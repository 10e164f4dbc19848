#include "metrics/masks.h"
#include "core/error.h"
#include "tests/error_message.h"

#include <gtest/gtest.h>
#include <limits>
#include <regex>

namespace {

struct Images {
    HostImage depth, normal, id, roughness, reflectance, confidence;

    explicit Images(glm::uvec2 extent)
        : depth(extent, 1, 2.0f),
          normal(extent, 3),
          id(extent, 1, 1.0f),
          roughness(extent, 1, 0.1f),
          reflectance(extent, 3, 0.04f),
          confidence(extent, 1) {
        for (size_t i = 0; i < normal.pixel_count(); ++i) normal.set_rgb(i, {0, 0, 1});
    }
    Mask mask(const std::string& name) const {
        return make_mask(name, {.view_depth = depth,
                                .normal = normal,
                                .material_id = id,
                                .roughness = roughness,
                                .reflectance = reflectance,
                                .confidence = confidence});
    }
};

}  // namespace

TEST(Masks, ReflectiveSplitsIntoHitAndMiss) {
    Images images({6, 1});
    images.roughness.values[1] = 0.61f;
    images.id.values[2] = 0;
    for (int c = 0; c < 3; ++c) images.reflectance.pixel(3, 0)[c] = 0.019f;
    images.reflectance.pixel(4, 0)[0] = 0.001f;  // the largest channel counts
    images.confidence.values = {0.5f, 1, 1, 1, 0.49f, 1};
    using Bytes = std::vector<uint8_t>;
    EXPECT_EQ(images.mask("all").inside, Bytes(6, 1));
    EXPECT_EQ(images.mask("reflective").inside, (Bytes{1, 0, 0, 0, 1, 1}));
    EXPECT_EQ(images.mask("hit").inside, (Bytes{1, 0, 0, 0, 0, 1}));
    EXPECT_EQ(images.mask("miss").inside, (Bytes{0, 0, 0, 0, 1, 0}));
    EXPECT_EQ(images.mask("hit").name, "hit");
}

TEST(Masks, SlantedPlanesHaveNoEdgesAtAnyScale) {
    // A floor 1 unit below the camera that runs to the horizon: depth = scale / (slope of the pixel's ray).
    for (const float scale : {1e-3f, 1.0f, 1e4f}) {
        Images images({20, 60});
        for (unsigned y = 0; y < 60; ++y)
            for (unsigned x = 0; x < 20; ++x) *images.depth.pixel(x, y) = scale / (0.01f * float(y + 1));
        EXPECT_EQ(images.mask("edge").count(), 0u) << scale;
        for (unsigned y = 0; y < 60; ++y) *images.depth.pixel(12, y) *= 0.9f;  // a thin pole before it
        EXPECT_EQ(images.mask("edge").count(), 3 * 60u) << scale;
    }
}

TEST(Masks, EdgesLieWithinOnePixelOfMaterialsAndNormals) {
    Images materials({10, 3}), normals({10, 3}), sky({10, 3});
    for (unsigned y = 0; y < 3; ++y)
        for (unsigned x = 5; x < 10; ++x) {
            *materials.id.pixel(x, y) = 2;
            normals.normal.set_rgb(y * 10 + x, {0, 1, 0});
            *sky.id.pixel(x, y) = 0;
            *sky.depth.pixel(x, y) = x == 5 ? 0 : std::numeric_limits<float>::infinity();
        }
    for (const Images* images : {&materials, &normals, &sky}) {
        const Mask edge = images->mask("edge");
        for (unsigned i = 0; i < 30; ++i) EXPECT_EQ(edge.inside[i], i % 10 == 4 || i % 10 == 5) << i;
    }
}

TEST(Masks, RoughnessClassesAreHalfOpen) {
    Images images({6, 1});
    images.roughness.values = {0, 0.0999f, 0.1f, 0.5f, 0.7f, 1};
    using Bytes = std::vector<uint8_t>;
    EXPECT_EQ(images.mask("roughness_0_0.1").inside, (Bytes{1, 1, 0, 0, 0, 0}));
    EXPECT_EQ(images.mask("roughness_0.1_.5").inside, (Bytes{0, 0, 1, 0, 0, 0}));
    EXPECT_EQ(images.mask("roughness_0.5_1").inside, (Bytes{0, 0, 0, 1, 1, 1}));  // beyond reflective_max_roughness
    EXPECT_EQ(images.mask("roughness_0.5_1").name, "roughness_0.5_1");
    images.id.values[0] = 0;
    for (int c = 0; c < 3; ++c) images.reflectance.pixel(1, 0)[c] = 0.019f;
    EXPECT_EQ(images.mask("roughness_0_0.1").count(), 0u);
}

TEST(Masks, RoughnessClassesAreReadFromTheirNames) {
    EXPECT_FALSE(roughness_class("reflective"));
    const RoughnessClass edges = *roughness_class("roughness_0.01_0.447");
    EXPECT_EQ(edges.from, 0.01f);
    EXPECT_EQ(edges.below, 0.447f);
    const std::regex pattern(roughness_class_pattern);
    for (const char* name : {"roughness_0_0.05", "roughness_0.6_1", "roughness_0.60_1.0", "roughness_.2_.3"}) {
        EXPECT_TRUE(roughness_class(name)) << name;
        EXPECT_TRUE(std::regex_match(name, pattern)) << name;
    }
    for (const char* name : {"roughness_", "roughness_0.1", "roughness_0.1_", "roughness_0.1_0.2_0.3", "roughness_a_b",
                             "roughness_0_1.5", "roughness_-0.1_0.2", "roughness_0_nan", "roughness_0_1e-1"}) {
        EXPECT_THROW(roughness_class(name), Error) << name;
        EXPECT_FALSE(std::regex_match(name, pattern)) << name;
    }
    EXPECT_THROW(roughness_class("roughness_0.2_0.1"), Error);
    EXPECT_THROW(roughness_class("roughness_0.2_0.2"), Error);
}

TEST(Masks, WithoutAFrameBeforeNothingIsDisoccluded) { EXPECT_EQ(Images({4, 4}).mask("disoccluded").count(), 0u); }

TEST(Masks, MistakesAreNamed) {
    Images images({4, 4});
    EXPECT_EQ(error_message([&] { images.mask("reflectiv"); }),
              "no mask named 'reflectiv'; did you mean 'reflective'?");
    EXPECT_NE(error_message([] { check_mask_name("x"); }).find("roughness_FROM_BELOW"), std::string::npos);
    images.roughness = HostImage({3, 4}, 1);
    EXPECT_THROW(images.mask("all"), Error);
}
