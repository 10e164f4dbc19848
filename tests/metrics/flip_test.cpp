#include "metrics/flip.h"
#include "core/error.h"
#include "metrics/color_map.h"
#include "metrics/flip_color.h"

#include <gtest/gtest.h>
#include <cmath>
#include <random>

namespace {

HostImage constant(glm::uvec2 extent, glm::vec3 color) {
    HostImage image(extent, 3);
    for (size_t i = 0; i < image.pixel_count(); ++i) image.set_rgb(i, color);
    return image;
}

float flip_of_constants(glm::vec3 a, glm::vec3 b) {
    return float(flip_map(constant({5, 3}, a), constant({5, 3}, b), default_pixels_per_degree).values[7]);
}

}  // namespace

TEST(Flip, ConstantImages) {
    // Published behaviour: green to blue is the greatest difference of all; black to white is not.
    EXPECT_NEAR(flip_of_constants({0, 1, 0}, {0, 0, 1}), 1, 1e-5);  // float32 chain of colour conversions
    EXPECT_NEAR(flip_of_constants({0, 0, 0}, {1, 1, 1}), 0.96738, 2e-5);
    EXPECT_EQ(flip_of_constants({0.3f, 0.2f, 0.1f}, {0.3f, 0.2f, 0.1f}), 0);
    EXPECT_EQ(flip_of_constants({1, 1, 1}, {9, 9, 9}), 0);  // both are white on a display
}

TEST(Flip, ColorConstants) {
    EXPECT_NEAR(hyab(hunt_lab_from_linear({0, 1, 0}), hunt_lab_from_linear({0, 0, 1})), 203.301656,
                2e-4);  // 1e-6 of it: float32
    const glm::vec3 white = relative_xyz_from_linear({1, 1, 1});
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(white[c], 1, 1e-6);
    for (float t = 0.0088f; t < 1.2f; t *= 1.01f)
        EXPECT_NEAR(cube_root(t) / std::cbrt(t), 1, 3e-7) << t;  // 5 roundings of 6e-8
    for (const glm::vec3 c : {glm::vec3(0.2f, 0.5f, 0.9f), glm::vec3(1, 0, 0)}) {
        const glm::vec3 back = linear_from_opponent(opponent_from_linear(c));
        for (int k = 0; k < 3; ++k) EXPECT_NEAR(back[k], c[k], 1e-5);  // the published inverse has 9 digits
    }
}

TEST(Flip, TilesLeaveNoSeams) {
    // A pattern that repeats every 8 pixels gives a map that does, far from the border, across borders of tiles too.
    HostImage a({300, 160}, 3), b = a;
    for (unsigned y = 0; y < 160; ++y)
        for (unsigned x = 0; x < 300; ++x)
            for (int c = 0; c < 3; ++c) {
                a.pixel(x, y)[c] = float((x % 8) * (y % 8)) / 49;
                b.pixel(x, y)[c] = float((x % 8) * (y % 8)) / 60 + 0.05f * float(c);
            }
    const Plane map = flip_map(a, b, default_pixels_per_degree);
    for (unsigned y = 16; y < 144; ++y)
        for (unsigned x = 16; x < 276; ++x) ASSERT_EQ(map.row(y)[x], map.row(16 + y % 8)[16 + x % 8]) << x << " " << y;
}

TEST(Flip, HdrIsTheGreatestOverItsExposures) {
    std::minstd_rand random(5);
    HostImage a({40, 30}, 3), b = a;
    for (float& v : a.values) v = 3 * std::generate_canonical<float, 24>(random);
    for (float& v : b.values) v = 3 * std::generate_canonical<float, 24>(random);
    const auto at = [&](float ev) {
        return hdr_flip_map(a, b, {ev, ev, 1}, ToneMap::hable, default_pixels_per_degree);
    };
    const Plane low = at(-2), middle = at(0), high = at(2);
    const Plane all = hdr_flip_map(a, b, {-2, 2, 3}, ToneMap::hable, default_pixels_per_degree);
    for (size_t i = 0; i < all.values.size(); ++i)
        ASSERT_EQ(all.values[i], std::max({low.values[i], middle.values[i], high.values[i]}));
}

TEST(Flip, AReferenceThatIsMostlyBlackPrescribesNoExposures) {
    HostImage image = constant({10, 10}, glm::vec3(0));
    for (size_t i = 0; i < 40; ++i) image.set_rgb(i, glm::vec3(2));
    try {
        flip_exposure_range(image, ToneMap::aces);
        FAIL() << "the median is 0";
    } catch (const Error& e) {
        EXPECT_NE(std::string(e.what()).find("median luminance of the reference is 0"), std::string::npos) << e.what();
    }
    for (size_t i = 0; i < 60; ++i) image.set_rgb(i, glm::vec3(2));
    const FlipExposures range = flip_exposure_range(image, ToneMap::reinhard);
    EXPECT_NEAR(range.start, std::log2(5.66666667 / 2), 1e-6);
    EXPECT_NEAR(range.stop, range.start, 1e-6);
    EXPECT_EQ(range.count, 2u);
    EXPECT_NEAR(radiance_of_85_percent(ToneMap::aces), 2.11887232, 1e-6);  // the curve's constants are float32
    EXPECT_NEAR(radiance_of_85_percent(ToneMap::hable), 3.12774928, 1e-6);
    EXPECT_THROW(radiance_of_85_percent(ToneMap::none), Error);
}

TEST(Flip, RefusesImpossibleObservers) {
    const HostImage image = constant({4, 4}, glm::vec3(1));
    EXPECT_THROW(flip_map(image, image, 0), Error);
    EXPECT_THROW(flip_map(image, image, NAN), Error);
    EXPECT_THROW(hdr_flip_map(image, image, {0, 1, 0}, ToneMap::aces, 67), Error);
}

TEST(ColorMap, MagmaRunsFromBlackToPaleYellow) {
    float previous = -1;
    for (int i = 0; i <= 255; ++i) {
        const glm::vec3 c = magma(i / 255.0);
        const float l = float(luminance(c.r, c.g, c.b));
        EXPECT_GE(l, previous - 1e-4f) << i;  // perceptually rising; codes are rounded to 1/255
        previous = l;
    }
    EXPECT_EQ(magma(-1), magma(0));
    EXPECT_EQ(magma(2), magma(1));
    Plane map({3, 1});
    map.values = {-2, 0, NAN};
    const HostImage picture = false_color_signed(map, 2);
    EXPECT_GT(picture.rgb(0).b, picture.rgb(0).r);
    EXPECT_EQ(picture.rgb(1), glm::vec3(1));
    EXPECT_TRUE(std::isnan(picture.rgb(2).x));
}
