#include "metrics/metric.h"
#include "core/error.h"
#include "tests/error_message.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <cmath>
#include <random>
#include <set>

namespace {

/// Grey pixels in one row.
HostImage row(const std::vector<float>& values) {
    HostImage image({unsigned(values.size()), 1}, 3);
    for (size_t i = 0; i < values.size(); ++i) image.set_rgb(i, glm::vec3(values[i]));
    return image;
}

HostImage noise(glm::uvec2 extent, unsigned seed, float scale) {
    std::minstd_rand random(seed);
    HostImage image(extent, 3);
    for (float& v : image.values) v = scale * std::generate_canonical<float, 24>(random);
    return image;
}

double value(const std::string& name, const ImagePair& pair, const Mask* mask = nullptr) {
    return measure(metric_named(name), pair, mask);
}

// Sums of a few values in double.
constexpr double rounding = 1e-12;

}  // namespace

TEST(Metric, FourPixelsByHand) {
    // d = 1, -1, 0.5, 0: the second and third pixels catch a missing absolute value and a reference of 0 that is left
    // out.
    const ImagePair pair = image_pair(row({1, 2, 0, 4}), row({2, 1, 0.5f, 4}), {});
    EXPECT_NEAR(value("mse", pair), (1 + 1 + 0.25 + 0) / 4, rounding);
    EXPECT_NEAR(value("mae", pair), 2.5 / 4, rounding);
    EXPECT_NEAR(value("relmse", pair), (1 / 1.01 + 1 / 4.01 + 0.25 / 0.01) / 4, rounding);
    EXPECT_NEAR(value("smape", pair), (1.0 / 3 + 1.0 / 3 + 1 + 0) / 4, rounding);
    EXPECT_NEAR(value("bias", pair), 0.5 / 4, rounding);
    EXPECT_NEAR(value("energy_ratio", pair), 7.5 / 7, rounding);
    EXPECT_EQ(value("outliers", pair), 1);  // 0.5 over black; 1 over 1 is not ten times too much
}

TEST(Metric, TrimmingDropsAThousandth) {
    std::vector<float> reference(2000, 1), test(2000, 1.1f);
    test[7] = test[1500] = 1e6f;
    const ImagePair pair = image_pair(row(reference), row(test), {});
    const double usual = std::pow(double(1.1f) - 1, 2) / 1.01;
    EXPECT_NEAR(value("relmse_trimmed", pair), usual, rounding);
    EXPECT_GT(value("relmse", pair), 1e8);
    EXPECT_EQ(value("outliers", pair), 2);
}

TEST(Metric, EqualImagesAreTheBestOfAll) {
    const HostImage image = noise({180, 177}, 3, 1);
    const ImagePair pair = image_pair(image, image, {.flip_exposures = flip_exposure_range(image, ToneMap::aces)});
    for (const Metric& metric : all_metrics()) {
        const double v = measure(metric, pair);
        const bool is_error = metric.better == Better::lower || metric.better == Better::near_zero;
        const double best = metric.name.starts_with("psnr") ? INFINITY
                            : is_error                      ? 0
                            : metric.name == "cvvdp_0_5_6"  ? 10
                                                            : 1;
        EXPECT_TRUE(v == best || std::abs(v - best) < rounding) << metric.name << " " << v;
    }
}

TEST(Metric, SymmetricOnesDoNotCareWhichIsTheReference) {
    const HostImage a = noise({180, 177}, 3, 1), b = noise({180, 177}, 4, 1);
    const ImagePair ab = image_pair(a, b, {}), ba = image_pair(b, a, {});
    for (const char* name : {"mse", "mae", "smape", "psnr", "ssim", "flip", "psnr_pu21", "ssim_pu21"})
        EXPECT_EQ(value(name, ab), value(name, ba)) << name;
    EXPECT_EQ(value("bias", ab), -value("bias", ba));
}

TEST(Metric, MasksChooseThePixelsOfTheMean) {
    const ImagePair pair = image_pair(row({1, 2, 0, 4}), row({2, 1, 0.5f, 4}), {});
    Mask mask = full_mask({4, 1});
    mask.inside = {0, 1, 1, 0};
    EXPECT_NEAR(value("mse", pair, &mask), (1 + 0.25) / 2, rounding);
    EXPECT_NEAR(value("energy_ratio", pair, &mask), 1.5 / 2, rounding);
    EXPECT_EQ(value("outliers", pair, &mask), 1);
    mask.inside = {0, 0, 0, 0};
    for (const char* name : {"mse", "relmse_trimmed", "outliers", "bias", "energy_ratio", "psnr", "flip"})
        EXPECT_TRUE(std::isnan(value(name, pair, &mask))) << name;
}

TEST(Metric, MasksSplitWindowedMapsIntoMeans) {
    const HostImage a = noise({180, 176}, 3, 1), b = noise({180, 176}, 4, 1);
    const ImagePair pair = image_pair(a, b, {});
    Mask left = full_mask({180, 176}), right = left;
    for (size_t i = 0; i < left.inside.size(); ++i) (i % 180 < 90 ? right : left).inside[i] = 0;
    // Both halves have as many windows, 85 columns of them for SSIM.
    for (const char* name : {"flip", "ssim"})
        EXPECT_NEAR(value(name, pair), (value(name, pair, &left) + value(name, pair, &right)) / 2, rounding) << name;
}

TEST(Metric, VisibilityIsThatOfTheWholeImage) {
    const ImagePair pair = image_pair(noise({40, 30}, 3, 1), noise({40, 30}, 4, 1), {});
    const double all = value("cvvdp_0_5_6", pair);
    EXPECT_LT(all, 9);
    Mask mask = full_mask({40, 30});
    mask.inside[7] = 0;
    EXPECT_EQ(value("cvvdp_0_5_6", pair, &mask), all);
    mask.name = "reflective";
    EXPECT_TRUE(std::isnan(value("cvvdp_0_5_6", pair, &mask)));
    mask = full_mask({40, 30});
    std::ranges::fill(mask.inside, uint8_t(0));
    EXPECT_TRUE(std::isnan(value("cvvdp_0_5_6", pair, &mask)));
}

TEST(Metric, VisibilitySeesTheExposureOfLinearDisplaysAndTheCodesOfOthers) {
    const HostImage a = noise({40, 30}, 3, 1), b = noise({40, 30}, 4, 1);
    HostImage half_a = a, half_b = b;
    for (float& v : half_a.values) v /= 2;
    for (float& v : half_b.values) v /= 2;
    const auto jod = [](const HostImage& a, const HostImage& b, float ev, const std::string& display) {
        return value("cvvdp_0_5_6",
                     image_pair(a, b, {.exposure_ev = ev, .viewing = {.display = display_named(display)}}));
    };
    for (const char* display : {"standard_hdr_linear", "standard_4k"}) {
        EXPECT_EQ(jod(a, b, 0, display), jod(half_a, half_b, 1, display));
        EXPECT_NE(jod(a, b, 0, display), jod(a, b, 1, display));
    }
    const MetricSettings coded{.viewing = {.display = display_named("standard_4k")}};
    const HostImage codes_a = display_codes(a, 0, ToneMap::none), codes_b = display_codes(b, 0, ToneMap::none);
    EXPECT_EQ(value("cvvdp_0_5_6", image_pair(half_a, half_b, codes_a, codes_b, coded)), jod(a, b, 0, "standard_4k"));
}

TEST(Metric, NonFinitePixelsAreCountedAndLeftOut) {
    HostImage reference = noise({32, 32}, 3, 1), test = noise({32, 32}, 4, 1);
    const ImagePair clean = image_pair(reference, test, {});
    HostImage broken = test;
    broken.set_rgb(40, {NAN, 1, 1});
    broken.set_rgb(41, {1, INFINITY, -1});
    broken.set_rgb(42, {-0.5f, 1, 1});
    reference.set_rgb(43, {1, 1, -INFINITY});
    const ImagePair pair = image_pair(reference, broken, {});
    EXPECT_EQ(pair.test_counts.nan, 1u);
    EXPECT_EQ(pair.test_counts.infinite, 1u);
    EXPECT_EQ(pair.test_counts.negative, 1u);
    EXPECT_EQ(pair.reference_counts.non_finite(), 1u);
    EXPECT_EQ(pair.finite.count(), 32u * 32 - 3);
    for (const char* name : {"mse", "relmse", "psnr", "ssim", "flip", "energy_ratio"})
        EXPECT_TRUE(std::isfinite(value(name, pair))) << name;
    Mask far = full_mask({32, 32});
    for (size_t i = 0; i < far.inside.size(); ++i) far.inside[i] = i / 32 > 20;
    EXPECT_EQ(value("mse", pair, &far), value("mse", clean, &far));
    EXPECT_EQ(value("flip", pair, &far), value("flip", clean, &far));  // windows reach 10 pixels
}

TEST(Metric, ThreadsDoNotChangeABit) {
    const HostImage a = noise({333, 207}, 3, 4), b = noise({333, 207}, 4, 4);
    const ImagePair pair = image_pair(a, b, {.flip_exposures = flip_exposure_range(a, ToneMap::aces)});
    for (const Metric& metric : all_metrics()) {
        const double usual = measure(metric, pair);
        for (const size_t threads : {1, 2, 7}) {
            const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
            EXPECT_EQ(measure(metric, pair), usual) << metric.name << " with " << threads << " threads";
        }
    }
}

TEST(Metric, DisplayMetricsSeeExposureAndToneMap) {
    const HostImage a = noise({32, 32}, 3, 0.25f), b = noise({32, 32}, 4, 0.25f);
    HostImage brighter_a = a, brighter_b = b;
    for (float& v : brighter_a.values) v *= 4;
    for (float& v : brighter_b.values) v *= 4;
    EXPECT_EQ(value("flip", image_pair(a, b, {.exposure_ev = 2})),
              value("flip", image_pair(brighter_a, brighter_b, {})));
    EXPECT_NE(value("flip", image_pair(a, b, {})), value("flip", image_pair(a, b, {.tone_map = ToneMap::aces})));
    EXPECT_EQ(value("mse", image_pair(a, b, {.exposure_ev = 2})), value("mse", image_pair(a, b, {})));
}

TEST(Metric, NamesAreUniqueAndMistakesAreNamed) {
    std::set<std::string> names, formulas;
    for (const Metric& metric : all_metrics()) {
        EXPECT_TRUE(names.insert(metric.name).second) << metric.name;
        EXPECT_TRUE(formulas.insert(metric.formula).second) << metric.formula;
    }
    EXPECT_NE(error_message([] { metric_named("relms"); }).find("no metric named 'relms'; did you mean 'relmse'?"),
              std::string::npos);
    EXPECT_NE(error_message([] {
                  image_pair(HostImage({2, 2}, 3), HostImage({2, 3}, 3), {});
              }).find("2x2 pixels, but the test image has 2x3"),
              std::string::npos);
    EXPECT_NE(error_message([] {
                  image_pair(HostImage({0, 0}, 3), HostImage({0, 0}, 3), {});
              }).find("zero size"),
              std::string::npos);
    const ImagePair small = image_pair(noise({100, 10}, 1, 1), noise({100, 10}, 2, 1), {});
    EXPECT_NE(error_message([&] { value("ssim", small); }).find("at least 11x11 pixels, but these have 100x10"),
              std::string::npos);
    EXPECT_NE(error_message([] { metric_named("ms_ssim"); }).find("use ssim"), std::string::npos);
    EXPECT_NE(error_message([&] { value("hdr_flip", small); }).find("range of exposures"), std::string::npos);
}
