#include "metrics/cvvdp/cvvdp.h"

#include "core/error.h"
#include "metrics/cvvdp/fast_power.h"
#include "metrics/cvvdp/pyramid.h"
#include "metrics/cvvdp/temporal_filters.h"
#include "tests/error_message.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

// ColorVideoVDP by closed forms; golden_cvvdp_test.cpp compares it with the authors' program.

namespace {

const CvvdpCalibration& calibration() { return cvvdp_0_5_6_calibration(); }

HostImage noise(glm::uvec2 extent, unsigned seed) {
    std::minstd_rand random(seed);
    HostImage image(extent, 3);
    for (float& v : image.values) v = std::generate_canonical<float, 24>(random);
    return image;
}

HostImage constant(glm::uvec2 extent, glm::vec3 color) {
    HostImage image(extent, 3);
    for (size_t i = 0; i < image.pixel_count(); ++i) image.set_rgb(i, color);
    return image;
}

Viewing on(const std::string& display) { return {.display = display_named(display)}; }

CvvdpScore score(const HostImage& reference, const HostImage& test, const std::string& display = "standard_4k") {
    return CvvdpStills(reference.extent, on(display)).score(reference, test, true);
}

CvvdpScore video_score(const std::vector<HostImage>& reference, const std::vector<HostImage>& test, double rate,
                       TemporalPadding padding) {
    CvvdpVideo video(reference[0].extent, on("standard_4k"), rate, padding);
    for (size_t f = 0; f < reference.size(); ++f) video.add(reference[f], test[f]);
    return video.score();
}

std::vector<HostImage> noises(glm::uvec2 extent, size_t count, unsigned seed) {
    std::vector<HostImage> frames;
    for (size_t f = 0; f < count; ++f) frames.push_back(noise(extent, seed + unsigned(f)));
    return frames;
}

}  // namespace

TEST(Cvvdp, EqualImagesScoreExactlyTen) {
    for (const glm::uvec2 extent : {glm::uvec2(61, 48), glm::uvec2(4, 4), glm::uvec2(7, 300)}) {
        const HostImage image = noise(extent, 1);
        const CvvdpScore still = score(image, image);
        EXPECT_EQ(still.jod, 10) << extent.x;
        EXPECT_TRUE(std::ranges::all_of(still.map.values, [](double v) { return v == 0; }));
    }
    const std::vector<HostImage> frames = noises({40, 30}, 5, 1);
    EXPECT_EQ(video_score(frames, frames, 30, TemporalPadding::replicate).jod, 10);
    EXPECT_EQ(video_score(frames, frames, 30, TemporalPadding::symmetric).jod, 10);
}

/// Contrasts are relative to the mean of each image, and greys have one chromaticity.
TEST(Cvvdp, GreyStepsOfAWholeImageAreNotSeenAndCastsAre) {
    Viewing viewing = on("standard_hdr_linear");
    viewing.nits_per_unit = 1;
    CvvdpStills stills({64, 48}, viewing);
    const HostImage grey = constant({64, 48}, glm::vec3(100));
    EXPECT_NEAR(stills.score(grey, constant({64, 48}, glm::vec3(200))).jod, 10, 1e-3);  // light of the room remains
    EXPECT_LT(stills.score(grey, constant({64, 48}, {108, 100, 88})).jod, 9.8);
    EXPECT_EQ(stills.score(constant({64, 48}, glm::vec3(1500)), constant({64, 48}, glm::vec3(9000))).jod,
              10);  // its peak
}

TEST(Cvvdp, JodFollowsItsCurve) {
    // 10 - 0.0439569391310215 Q^0.9302042722702026 with 6 digits after the point.
    EXPECT_NEAR(jod(1, calibration()), 9.956043, 5e-7);
    EXPECT_NEAR(jod(10, calibration()), 9.625690, 5e-7);
    EXPECT_NEAR(jod(100, calibration()), 6.812604, 5e-7);
    EXPECT_EQ(jod(0, calibration()), 10);
    EXPECT_NEAR(jod(0.1, calibration()), jod(std::nextafter(0.1, 1), calibration()), 1e-12);
}

TEST(Cvvdp, FastPowersAreThoseOfTheLibrary) {
    for (float x = 1e-30f; x < 1e30f; x *= 1.37f)
        EXPECT_NEAR(fast_log2(x), std::log2(double(x)), 1e-7 * (1 + std::abs(std::log2(x)))) << x;
    EXPECT_EQ(fast_log2(1), 0);
    for (float y = -125; y < 126; y += 0.173f) EXPECT_NEAR(fast_exp2(y) / std::exp2(double(y)), 1, 3e-7) << y;
    EXPECT_EQ(fast_exp2(3), 8);
}

TEST(Cvvdp, DisplaysMakeLight) {
    // Pixels per degree that the original program computes from the same screens.
    EXPECT_NEAR(display_named("standard_4k").pixels_per_degree, 75.40244934516305, 1e-9);
    EXPECT_NEAR(display_named("standard_fhd").pixels_per_degree, 37.842503853602885, 1e-9);
    const float codes[] = {-1, 0, 0.02f, 0.5f, 1, 2};
    float light[6];
    displayed_light(on("standard_4k"), codes, light, 6);
    const double base = 0.2 + 250 / std::numbers::pi * 0.005;
    EXPECT_NEAR(light[0], base, 1e-6);
    EXPECT_NEAR(light[1], base, 1e-6);
    EXPECT_NEAR(light[2], 199.8 * 0.02 / 12.92 + base, 1e-5);
    EXPECT_NEAR(light[3], 199.8 * std::pow(0.555 / 1.055, 2.4) + base, 1e-4);  // 3e-7 of it, and float32
    EXPECT_NEAR(light[4], 200 + 250 / std::numbers::pi * 0.005, 1e-4);
    EXPECT_EQ(light[5], light[4]);
    Viewing viewing = on("standard_hdr_linear");
    const float radiance[] = {-1, 0, 1e-5f, 1, 8};
    displayed_light(viewing, radiance, light, 5);
    const double room = 10 / std::numbers::pi * 0.005;
    EXPECT_NEAR(light[0], 0.005 + room, 1e-8);
    EXPECT_NEAR(light[2], 0.005 + room, 1e-8);
    EXPECT_NEAR(light[3], 203 + room, 2e-5);
    EXPECT_NEAR(light[4], 1500 + room, 2e-4);
    EXPECT_NE(error_message([] { display_named("standard_8k"); }).find("did you mean 'standard_4k'?"),
              std::string::npos);
}

TEST(Cvvdp, FiltersPassAndBlockConstants) {
    for (const double rate : {1.0, 24.0, 30.0, 59.94, 60.0, 120.0, 240.0}) {
        const auto filters = temporal_filters(rate, calibration());
        for (unsigned c = 0; c < cvvdp_channels; ++c) {
            EXPECT_EQ(filters[c].size(), 2 * size_t(std::ceil(rate / 8)) + 1);
            double sum = 0;
            for (const float tap : filters[c]) sum += tap;
            EXPECT_NEAR(sum, c == 3 ? 0 : 1, 2e-6) << rate;  // 61 float32 taps; the transient response at 0 Hz is 3e-7
            for (size_t j = 0; j < filters[c].size(); ++j)
                EXPECT_NEAR(filters[c][j], filters[c][filters[c].size() - 1 - j], 1e-7);
        }
    }
    for (const double rate : {0.0, -30.0, 1000.0, double(NAN)})
        EXPECT_NE(error_message([&] { temporal_filters(rate, calibration()); }).find("frames per second"),
                  std::string::npos);
}

TEST(Cvvdp, LevelsOfConstantsAreConstantButForTheLastColumn) {
    for (const glm::uvec2 size : {glm::uvec2(8, 6), glm::uvec2(9, 7), glm::uvec2(8, 7), glm::uvec2(9, 6)}) {
        FloatPlane fine(size.x, size.y), coarse((size.x + 1) / 2, (size.y + 1) / 2);
        std::ranges::fill(fine.values, 3.0f);
        reduce(fine, coarse);
        // The weights of the last column sum to 1 where the parities of width and height agree.
        const double last = size.x % 2 == size.y % 2 ? 1 : size.y % 2 == 1 ? 1.25 : 0.75;
        for (unsigned y = 0; y < coarse.height; ++y)
            for (unsigned x = 0; x < coarse.width; ++x)
                EXPECT_NEAR(coarse.row(y)[x], x + 1 < coarse.width ? 3 : 3 * last, 1e-6) << size.x << "x" << size.y;
        std::ranges::fill(coarse.values, 3.0f);
        std::vector<float> row(size.x), scratch;
        for (unsigned y = 0; y < size.y; ++y) {
            expand_row(coarse, y, row.data(), size.x, scratch);
            for (const float v : row) EXPECT_NEAR(v, 3, 1e-6);
        }
    }
}

TEST(Cvvdp, BandsHaveTheOriginalsFrequencies) {
    const std::vector<double> bands = band_frequencies({1920, 1080}, display_named("standard_4k").pixels_per_degree);
    const std::vector<double> expected = {37.7012, 12.16996, 6.08498, 3.04249, 1.52124, 0.76062, 0.38031, 0.19016, 0.1};
    ASSERT_EQ(bands.size(), expected.size());
    for (size_t b = 0; b < bands.size(); ++b) EXPECT_NEAR(bands[b], expected[b], 5e-5);  // their last digit
    EXPECT_EQ(band_frequencies({1920, 1080}, display_named("standard_fhd").pixels_per_degree).size(), 8u);
    EXPECT_EQ(band_frequencies({320, 180}, 75.4).size(), 7u);
    EXPECT_EQ(band_frequencies({4, 4}, 75.4).size(), 2u);
    EXPECT_NE(error_message([] { band_frequencies({3, 500}, 75.4); }).find("at least 4x4 pixels"), std::string::npos);
    EXPECT_NE(error_message([] { band_frequencies({64, 64}, 0.5); }).find("pixels per degree"), std::string::npos);
}

TEST(Cvvdp, SensitivitiesInterpolateTheTable) {
    // Node 9 of the frequencies, nodes 4 and 5 of the backgrounds, halfway in logarithms.
    const double frequency = 0.1 * std::pow(640.0, 9 / 31.0), correction = -0.2797423303127289 / 20;
    const BandSensitivity band(frequency, calibration());
    const float log2_step = float(std::log2(2e6) / 31), log2_low = float(std::log2(0.005));
    const float backgrounds[] = {log2_low + 4 * log2_step, log2_low + 4.5f * log2_step, log2_low - 3, 30};
    float s[4];
    for (unsigned c = 0; c < cvvdp_channels; ++c) {
        band.row(c, backgrounds, s, 4);
        const auto table = [&](unsigned b) { return double(sensitivity_table()[c][b][9]); };
        // 1e-5: places among nodes are float32, and a step of the table is up to a factor of two.
        EXPECT_NEAR(s[0] / std::pow(10, table(4) + correction), 1, 1e-5);
        EXPECT_NEAR(s[1] / std::pow(10, (table(4) + table(5)) / 2 + correction), 1, 1e-5);
        EXPECT_NEAR(s[2] / std::pow(10, table(0) + correction), 1, 1e-5);
        EXPECT_NEAR(s[3] / std::pow(10, table(31) + correction), 1, 1e-5);
    }
}

TEST(Cvvdp, NonFinitePixelsAreBlackInBothAndCounted) {
    HostImage reference = noise({48, 40}, 1), test = noise({48, 40}, 2);
    HostImage black_reference = reference, black_test = test;
    for (const size_t i : {50, 51, 300}) black_reference.set_rgb(i, glm::vec3(0)), black_test.set_rgb(i, glm::vec3(0));
    test.set_rgb(50, {NAN, 0.5f, 0.5f});
    test.set_rgb(51, {0.5f, 0.5f, -INFINITY});
    reference.set_rgb(300, {0.5f, INFINITY, 0.5f});
    const CvvdpScore found = score(reference, test), expected = score(black_reference, black_test);
    EXPECT_EQ(found.non_finite, 3u);
    EXPECT_EQ(expected.non_finite, 0u);
    EXPECT_EQ(found.jod, expected.jod);
}

TEST(Cvvdp, ThreadsDoNotChangeABit) {
    const HostImage reference = noise({301, 401}, 1), test = noise({301, 401}, 2);  // four strips
    const std::vector<HostImage> frames = noises({40, 170}, 4, 1), others = noises({40, 170}, 4, 9);
    const double usual = score(reference, test).jod,
                 usual_video = video_score(frames, others, 30, TemporalPadding::replicate).jod;
    for (const size_t threads : {1, 2, 7}) {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
        EXPECT_EQ(score(reference, test).jod, usual) << threads;
        EXPECT_EQ(video_score(frames, others, 30, TemporalPadding::replicate).jod, usual_video) << threads;
    }
}

TEST(Cvvdp, WarmUpPoolsFramesWithAFullWindow) {
    const std::vector<HostImage> reference = noises({24, 20}, 11, 1), test = noises({24, 20}, 11, 50);
    const CvvdpScore all = video_score(reference, test, 30, TemporalPadding::replicate),
                     full = video_score(reference, test, 30, TemporalPadding::warm_up);
    ASSERT_EQ(full.frames.size(), 11u - 9 + 1);  // 9 taps at 30 frames per second
    for (size_t f = 0; f < full.frames.size(); ++f) EXPECT_EQ(full.frames[f], all.frames[f + 8]);
    EXPECT_EQ(full.jod, jod(pooled_difference({all.frames.begin() + 8, all.frames.end()}, 4, false, calibration()),
                            calibration()));
}

TEST(Cvvdp, MirroredStartsShowFramesInReverse) {
    // Frames 3 2 1 0 1 2 3 as a video of their own: its windows that begin at the first are those of the mirrored one.
    const std::vector<HostImage> reference = noises({24, 20}, 5, 1), test = noises({24, 20}, 5, 50);
    const auto mirrored = [](const std::vector<HostImage>& frames) {
        std::vector<HostImage> longer = {frames[4], frames[3], frames[2], frames[1]};
        longer.insert(longer.end(), frames.begin(), frames.end());
        return longer;
    };
    const double rate = 16;  // 5 taps
    const CvvdpScore symmetric = video_score(reference, test, rate, TemporalPadding::symmetric),
                     longer = video_score(mirrored(reference), mirrored(test), rate, TemporalPadding::warm_up);
    ASSERT_EQ(longer.frames.size(), 5u);
    EXPECT_EQ(symmetric.frames, longer.frames);
}

TEST(Cvvdp, RefusesWhatItCannotCompare) {
    const HostImage image = noise({20, 20}, 1);
    const auto says = [](const std::string& text, const std::function<void()>& wrong) {
        EXPECT_NE(error_message(wrong).find(text), std::string::npos) << error_message(wrong);
    };
    says("20x21", [&] { score(image, noise({20, 21}, 1)); });
    says("three of a colour", [&] { score(HostImage({20, 20}, 4), HostImage({20, 20}, 4)); });
    says("would be shown with 0 cd/m2", [&] { CvvdpStills({20, 20}, {on("standard_hdr_linear").display, 0}); });
    EXPECT_NO_THROW(CvvdpStills({20, 20}, {on("standard_4k").display, 0})) << "codes have no radiance";
    says("at least two frames, but has 1", [&] { video_score({image}, {image}, 30, TemporalPadding::replicate); });
    says("need 9 frames before one can be scored, but there are 2", [&] {
        video_score({image, image}, {image, image}, 30, TemporalPadding::warm_up);
    });
}
