// Which pixels hold the noise of a reference: made-up variances, in closed form.
#include "experiments/study/measuring/noise_places.h"

#include <gtest/gtest.h>

TEST(NoisePlaces, NameTheNoisiestPixelsAndTheirSurfaces) {
    // 200 pixels: two of a mirror hold 89 %, the other 198 of a rough surface the rest. One more lies outside of the
    // mask.
    const glm::uvec2 extent(201, 1);
    HostImage variance(extent, 3), roughness(extent, 1);
    Mask mask{.name = "reflective", .extent = extent, .inside = std::vector<uint8_t>(201, 1)};
    for (size_t i = 0; i < 200; ++i) {
        for (size_t c = 0; c < 3; ++c) variance.values[3 * i + c] = i < 2 ? 0.445f : 0.11f / 198;
        roughness.values[i] = i < 2 ? 0.05f : 0.3f;  // on an edge of the classes: the rougher one's
    }
    variance.values[600] = 100, mask.inside[200] = 0;
    const NoisePlaces places = noise_places(variance, roughness, mask);
    EXPECT_EQ(places.pixels, 200u);
    EXPECT_NEAR(places.noisiest_share, 0.89, 1e-6);
    EXPECT_NEAR(places.carriers, 1 / (2 * 0.445 * 0.445 + 0.11 * 0.11 / 198), 1e-4);
    ASSERT_EQ(places.by_roughness.size(), 2u);
    EXPECT_EQ(places.by_roughness[0].edges.below, 0.1f);
    EXPECT_NEAR(places.by_roughness[0].pixel_share, 0.01, 1e-9);
    EXPECT_NEAR(places.by_roughness[0].variance_share, 0.89, 1e-6);
    EXPECT_EQ(places.by_roughness[1].edges.from, 0.3f);
    EXPECT_NEAR(places.by_roughness[1].variance_share, 0.11, 1e-6);

    const nlohmann::json entry = noise_entry(places, "specular", "reflective");
    EXPECT_EQ(entry["mask"], "reflective");
    EXPECT_EQ(entry["by_roughness"][0]["below"], 0.1) << "as it was written, not as a float is";
}

TEST(NoisePlaces, OfNoNoiseAndOfNoPixelsAreNowhere) {
    const glm::uvec2 extent(4, 1);
    Mask mask{.name = "all", .extent = extent, .inside = std::vector<uint8_t>(4, 1)};
    const NoisePlaces exact = noise_places(HostImage(extent, 3), HostImage(extent, 1), mask);
    EXPECT_EQ(exact.pixels, 4u);
    EXPECT_EQ(exact.noisiest_share, 0);
    EXPECT_EQ(exact.carriers, 0);
    mask.inside.assign(4, 0);
    const NoisePlaces none = noise_places(HostImage(extent, 3), HostImage(extent, 1), mask);
    EXPECT_EQ(none.pixels, 0u);
    EXPECT_TRUE(none.by_roughness.empty());
}
