#include "metrics/pu21.h"

#include <gtest/gtest.h>
#include <cmath>

namespace {

ImagePair constants(float reference, float test) {
    return image_pair(HostImage({16, 16}, 3, reference), HostImage({16, 16}, 3, test), {.exposure_ev = 1});
}

/// Of radiance on the default display at one stop, which adds the room's light of 10 lux to 2 x 203 cd/m2 per unit.
double code(double radiance) { return pu21_code(406 * radiance + 10 / M_PI * 0.005); }

}  // namespace

TEST(Pu21, CodesAreThoseOfTheAuthors) {
    // The encoding is made to begin at 0 and to give 256 at 100 cd/m2, which its authors' fit reaches to 0.4.
    EXPECT_NEAR(pu21_code(0.005), 0, 1e-6);
    EXPECT_NEAR(pu21_code(100), 256, 0.4);
    // By a program in Python from the published formula and constants.
    EXPECT_NEAR(pu21_code(0.1), 5.717073839669447, 1e-9);
    EXPECT_NEAR(pu21_code(10), 123.64748355384738, 1e-9);
    EXPECT_NEAR(pu21_code(10000), 595.393920020095, 1e-9);
    EXPECT_EQ(pu21_code(0), pu21_code(0.005));
    EXPECT_EQ(pu21_code(-1), pu21_code(0.005));
    EXPECT_EQ(pu21_code(1e6), pu21_code(10000));
}

TEST(Pu21, ConstantImagesHaveClosedForms) {
    const ImagePair pair = constants(0.5f, 0.75f);
    const double r = code(0.5), x = code(0.75);
    // Codes are float32, so their difference of 36 is known to 4e-7 of itself.
    EXPECT_NEAR(measure(metric_named("psnr_pu21"), pair), -20 * std::log10((x - r) / 256), 1e-5);
    const double c1 = std::pow(0.01 * 256, 2);
    EXPECT_NEAR(measure(metric_named("ssim_pu21"), pair), (2 * r * x + c1) / (r * r + x * x + c1), 1e-6);
}

TEST(Pu21, SeesHighlightsThatCodesClip) {
    const ImagePair pair = constants(1, 2);  // 406 and 812 cd/m2; both are white to sRGB codes
    EXPECT_EQ(measure(metric_named("psnr"), pair), INFINITY);
    EXPECT_LT(measure(metric_named("psnr_pu21"), pair), 15);
}
