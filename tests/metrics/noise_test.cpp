#include "metrics/noise.h"
#include "core/error.h"
#include "metrics/score.h"
#include "metrics/statistics/estimates.h"

#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>
#include <random>

namespace {

using Random = std::mt19937;

/// A smooth, coloured truth with a step.
HostImage truth_image(glm::uvec2 extent) {
    HostImage image(extent, 3);
    for (unsigned y = 0; y < extent.y; ++y)
        for (unsigned x = 0; x < extent.x; ++x)
            for (int c = 0; c < 3; ++c)
                image.pixel(x, y)[c] =
                    (x > extent.x / 2 ? 2.0f : 0.5f) + 0.3f * std::sin(0.1f * float(x + y * unsigned(c + 1)));
    return image;
}

/// The truth plus noise whose standard deviation is `relative` of it.
HostImage with_noise(const HostImage& truth, const Plane& relative, Random& random) {
    HostImage image = truth;
    std::normal_distribution<float> normal;
    for (size_t i = 0; i < image.values.size(); ++i)
        image.values[i] *= 1 + float(relative.values[i / 3]) * normal(random);
    return image;
}

Plane constant(glm::uvec2 extent, double value) {
    Plane plane(extent);
    plane.values.assign(plane.values.size(), value);
    return plane;
}

HostImage with_noise(const HostImage& truth, float relative, Random& random) {
    return with_noise(truth, constant(truth.extent, relative), random);
}

/// A guide that is no good: it is off by a third, and more where it is dark.
HostImage poor_guide(const HostImage& truth) {
    HostImage guide = truth;
    for (float& v : guide.values) v = 1.3f * v + 0.1f;
    return guide;
}

/// Halves whose noise relative to the truth is `relative` each. Batches estimate the variance with 14 degrees of
/// freedom.
ReferenceHalves noisy_halves(const HostImage& truth, const Plane& relative, Random& random) {
    ReferenceHalves halves{.a = with_noise(truth, relative, random),
                           .b = with_noise(truth, relative, random),
                           .variance = truth,
                           .guide = poor_guide(truth),
                           .samples = 1024};
    std::chi_squared_distribution<float> chi_squared(14);
    for (size_t i = 0; i < truth.values.size(); ++i) {
        const float deviation = float(relative.values[i / 3]) * truth.values[i];
        halves.variance.values[i] = deviation * deviation / 2 * chi_squared(random) / 14;
    }
    return halves;
}

HostImage mean_of(const HostImage& a, const HostImage& b) {
    HostImage mean = a;
    for (size_t i = 0; i < mean.values.size(); ++i) mean.values[i] = (a.values[i] + b.values[i]) / 2;
    return mean;
}

/// What the metric says of the truth itself, with the weights of the guide.
double exact(const char* metric, const HostImage& truth, const HostImage& test) {
    const ReferenceHalves halves{
        .a = truth, .b = truth, .variance = HostImage(truth.extent, 3), .guide = poor_guide(truth), .samples = 256};
    const Mask all = full_mask(truth.extent);
    return score(metric_reference(truth, halves, {metric}, {}), test, std::span(&all, 1)).front().value;
}

struct Simulation {
    std::vector<double> values, naive;
    int intervals = 0, covered = 0;
    double half_width = 0;  ///< mean
};

/// Many references of the same truth against one test image.
Simulation simulate(const char* metric, const HostImage& truth, const HostImage& test, const Plane& relative_noise,
                    int repeats, const Mask& mask) {
    Random random(11);
    Simulation result;
    const auto value_of = [&](const MetricReference& reference) {
        return score(reference, test, std::span(&mask, 1)).front();
    };
    const ReferenceHalves none = noisy_halves(truth, constant(truth.extent, 0), random);
    const double expected = value_of(metric_reference(truth, none, {metric}, {})).value;
    for (int i = 0; i < repeats; ++i) {
        const ReferenceHalves halves = noisy_halves(truth, relative_noise, random);
        const Score s = value_of(metric_reference(mean_of(halves.a, halves.b), halves, {metric}, {}));
        result.values.push_back(s.value);
        result.naive.push_back(s.uncorrected);
        if (!s.low) continue;
        ++result.intervals;
        result.covered += *s.low <= expected && expected <= *s.high;
        result.half_width += (*s.high - *s.low) / 2;
    }
    result.half_width /= result.intervals;
    return result;
}

/// Four standard deviations of 400 trials that cover 95 %, and 1 % that Student's t of a guessed number of degrees may
/// be off by: a false alarm of 6e-5, and the seed is fixed.
void expect_coverage(const Simulation& s, const char* what) {
    EXPECT_EQ(s.intervals, 400) << what;
    EXPECT_GE(s.covered, 400 * 0.94 - 4 * 4.36) << what;
    EXPECT_LE(s.covered, 400 * 0.96 + 4 * 4.36 - 1) << what << ": wider than needed";
}

Mask some_pixels(glm::uvec2 extent, const std::vector<size_t>& pixels) {
    Mask mask = full_mask(extent);
    mask.inside.assign(mask.inside.size(), 0);
    for (const size_t p : pixels) mask.inside[p] = 1;
    return mask;
}

double standard_error(const Estimate& e, size_t n) { return (e.high - e.value) / (n > 100 ? 1.97 : 2.02); }

}  // namespace

TEST(Noise, CorrectedSquaredErrorsAreUnbiasedWhateverTheGuideIs) {
    const HostImage truth = truth_image({24, 24});
    Random random(3);
    const HostImage test = with_noise(truth, 0.2f, random);
    for (const char* metric : {"mse", "relmse"}) {
        const double expected = exact(metric, truth, test);
        const Simulation s = simulate(metric, truth, test, constant(truth.extent, 0.3), 200, full_mask(truth.extent));
        const Estimate corrected = mean_estimate(s.values), naive = mean_estimate(s.naive);
        // Four standard errors: a false alarm of 6e-5, and the seed is fixed.
        EXPECT_NEAR(corrected.value, expected, 4 * standard_error(corrected, 200)) << metric;
        EXPECT_LT(std::abs(corrected.value - expected), 0.25 * s.half_width) << metric;
        EXPECT_GT(naive.value, expected * 1.5) << metric;  // the reference's own noise: 0.3^2 / 2 on top of 0.2^2
    }
}

TEST(Noise, IntervalsCoverTheTruthAtTheirRate) {
    const glm::uvec2 extent(24, 24);
    const HostImage truth = truth_image(extent);
    Random random(3);
    const HostImage test = with_noise(truth, 0.1f, random);
    const Mask all = full_mask(extent);
    const Plane even = constant(extent, 0.2);
    for (const char* metric : {"mse", "relmse", "bias", "energy_ratio"})
        expect_coverage(simulate(metric, truth, test, even, 400, all), metric);

    // One corner of 8x8 pixels is five times noisier.
    Plane corner = constant(extent, 0.1);
    for (unsigned y = 0; y < 8; ++y)
        for (unsigned x = 0; x < 8; ++x) corner.row(y)[x] = 0.5;
    expect_coverage(simulate("mse", truth, test, corner, 400, all), "a noisy corner");
    const Mask ten = some_pixels(extent, {3, 19, 99, 140, 207, 300, 341, 441, 499, 570});
    expect_coverage(simulate("bias", truth, test, even, 400, ten), "ten pixels");
    // Three pixels of which each has ten times the deviation of the others.
    Plane few = constant(extent, 0.02);
    for (const size_t p : {100, 300, 500}) few.values[p] = 0.4;
    expect_coverage(simulate("bias", truth, test, few, 400, all), "three pixels carry the noise");
}

TEST(Noise, ExtrapolatedIntervalsCoverWhateverTheMeanIsMadeInto) {
    const glm::uvec2 extent(64, 48);  // a trimmed mean leaves three of these pixels out
    const HostImage truth = truth_image(extent);
    Random random(3);
    const HostImage test = with_noise(truth, 0.2f, random);
    for (const char* metric : {"relmse_trimmed", "psnr", "outliers"}) {
        const Simulation s = simulate(metric, truth, test, constant(extent, 0.2), 100, full_mask(extent));
        EXPECT_EQ(s.intervals, 100) << metric;
        // Four deviations of 95 % of 100: a false alarm of 3e-5. They reach to both laws, so more may be covered.
        EXPECT_GE(s.covered, 95 - 4 * 2.2) << metric;
    }
    // With the reference as it is the value is another: what is added is not in the value, but in the interval.
    const Simulation s = simulate("psnr", truth, test, constant(extent, 0.2), 20, full_mask(extent));
    EXPECT_LT(s.half_width, 3) << "dB";
    EXPECT_GT(s.half_width, 0.05);
}

TEST(Noise, NoIntervalIsGivenWhereNoneWouldCover) {
    const glm::uvec2 extent(48, 48);
    const HostImage truth = truth_image(extent), test = poor_guide(truth);
    Plane one = constant(extent, 0.001);
    one.values[1000] = 0.5;
    EXPECT_EQ(simulate("mse", truth, test, one, 20, full_mask(extent)).intervals, 0) << "one pixel carries the noise";
    const Mask ten = some_pixels(extent, {3, 99, 300, 441, 640, 807, 999, 1203, 1500, 2001});
    NoisyMap terms = noisy_map(extent, 410);
    for (double& v : terms.swapped.values) v = 2;
    for (double& v : terms.variance.values) v = 4;
    ASSERT_TRUE(noise_half_width(terms, ten));
    EXPECT_NEAR(*noise_half_width(terms, ten), 2.228138852 * 2 * std::sqrt(10), 1e-8);  // t of 10 degrees, from tables
    EXPECT_NEAR(*noise_half_width(terms, full_mask(extent)), 1.961003 * 2 * 48, 1e-3);  // of 2304
    terms.samples = 409;
    EXPECT_FALSE(noise_half_width(terms, ten)) << "4090 samples miss what is rare";
    EXPECT_TRUE(noise_half_width(terms, full_mask(extent)));
    EXPECT_EQ(simulate("ssim", truth, test, constant(extent, 0.1), 1, full_mask(extent)).intervals, 0)
        << "SSIM without the noise is not known";
}

/// Rare bright paths: one in 200 of the halves of the pixels holds one, whose brightness is log-normal of deviation 1.
/// Whether there is an interval must not depend on how many were found, for those that found few are too narrow.
TEST(Noise, IntervalsOfRarePathsAreNotThoseOfLuckyReferencesAlone) {
    const glm::uvec2 extent(48, 48);
    const Mask all = full_mask(extent), few = some_pixels(extent, {3, 99, 300, 441, 640, 807, 999, 1203, 1500, 2001});
    Random random(7);
    std::lognormal_distribution<double> brightness(0, 1);
    const double expected = double(all.count()) / 200 * std::exp(0.5);
    constexpr int references = 2000;
    int given = 0, covered = 0, lucky = 0, covered_of_lucky = 0;
    for (int i = 0; i < references; ++i) {
        NoisyMap terms = noisy_map(extent, 64);
        double sum = 0, squares = 0, fourths = 0;
        for (size_t p = 0; p < terms.swapped.values.size(); ++p) {
            double halves[2];
            for (double& half : halves) half = random() % 200 == 0 ? brightness(random) : 0;
            sum += (halves[0] + halves[1]) / 2;
            // One path is in one of 16 batches: their variance is just the square of what it moves the mean by.
            const double moved = (halves[1] - halves[0]) / 2, square = moved * moved;
            terms.swapped.values[p] = moved, terms.variance.values[p] = square + 1e-9;  // all pixels are noisy
            squares += square, fourths += square * square;
        }
        EXPECT_FALSE(noise_half_width(terms, few).value_or(0) > 0) << "640 samples know nothing of such paths";
        const std::optional<double> half_width = noise_half_width(terms, all);
        if (!half_width) continue;
        const bool is_covered = std::abs(sum - expected) <= *half_width, is_lucky = squares * squares > 6 * fourths;
        ++given, covered += is_covered, lucky += is_lucky, covered_of_lucky += is_lucky && is_covered;
    }
    EXPECT_GE(given, 0.97 * references) << "all but those in which one path is nearly all";
    // 93.2 % of 4000 others, less four deviations of 11.3: a false alarm of 3e-5.
    EXPECT_GE(covered, 0.932 * given - 4 * 11.3);
    // Were an interval given where six pixels or more carry the noise, 30 % would have one, of which 89 % would cover.
    EXPECT_LT(lucky, 0.4 * references);
    EXPECT_LT(double(covered_of_lucky) / lucky, double(covered) / given - 0.01) << "the lucky";
}

TEST(Noise, OfDifferencesIsToldByFewPixelsIfEitherSaysSo) {
    // 64 pixels. The swaps of 16 are 1, and the batches find the same variance in all: 16 degrees, of what is no
    // difference 64. If they find it in 10 of them alone it is 10. Student's t from tables.
    const Mask all = full_mask({8, 8});
    const auto half_width = [&](size_t swapped_pixels, size_t variance_pixels, bool is_difference) {
        NoisyMap terms = noisy_map({8, 8}, 1024);
        std::fill_n(terms.swapped.values.begin(), swapped_pixels, 1.0);
        std::fill_n(terms.variance.values.begin(), variance_pixels, 2.0);
        terms.is_difference = is_difference;
        return noise_half_width(terms, all);
    };
    EXPECT_NEAR(half_width(16, 64, true).value(), 2.119905 * 4, 1e-4);
    EXPECT_NEAR(half_width(16, 64, false).value(), 1.997730 * 4, 1e-4);
    EXPECT_NEAR(half_width(16, 10, true).value(), 2.228139 * 4, 1e-4);
    EXPECT_NEAR(half_width(16, 10, false).value(), 2.228139 * 4, 1e-4);
    EXPECT_TRUE(half_width(8, 64, true));
    EXPECT_FALSE(half_width(7, 64, true)) << "seven pixels carry all of the difference";
    EXPECT_TRUE(half_width(7, 64, false));
}

TEST(Noise, TheRatioOfMeansHasAnIntervalOfItsOwn) {
    // x = 2 and R = 1 +- h: 2 / (1 + h) to 2 / (1 - h), not 2 +- 2 h.
    const glm::uvec2 extent(20, 20);
    ReferenceHalves halves{.a = HostImage(extent, 3, 1.1f),
                           .b = HostImage(extent, 3, 0.9f),
                           .variance = HostImage(extent, 3, 0.01f),
                           .guide = HostImage(extent, 3, 1.0f),
                           .samples = 16};
    const Mask all = full_mask(extent);
    const MetricReference reference = metric_reference(HostImage(extent, 3, 1.0f), halves, {"energy_ratio"}, {});
    const Score s = score(reference, HostImage(extent, 3, 2.0f), std::span(&all, 1)).front();
    const double h = 1.965912 * 0.1 / 20;  // t of 400 degrees; all pixels are off by 0.1
    EXPECT_NEAR(s.value, 2, 1e-6);
    EXPECT_NEAR(*s.low, 2 / (1 + h), 1e-6);
    EXPECT_NEAR(*s.high, 2 / (1 - h), 1e-6);
}

TEST(Noise, ValuesOfSeveralFramesMoveAsTheirNoiseTells) {
    // The noise of a score is its derivative: swapping the halves of one pixel moves the value by twice its term.
    const glm::uvec2 extent(24, 24);
    const HostImage truth = truth_image(extent);
    Random random(3);
    const HostImage test = poor_guide(truth);
    ReferenceHalves halves = noisy_halves(truth, constant(extent, 1e-3), random);
    const Mask all = full_mask(extent);
    for (const char* metric : {"mse", "relmse", "bias", "energy_ratio"}) {
        const auto value_of = [&](const HostImage& a, std::vector<NoisyMap>* noise) {
            ReferenceHalves only = halves;
            only.a = only.b = a;
            const MetricReference reference = metric_reference(a, noise ? halves : only, {metric}, {});
            return score(reference, test, std::span(&all, 1), nullptr, noise).front().value;
        };
        std::vector<NoisyMap> noise;
        value_of(mean_of(halves.a, halves.b), &noise);
        ASSERT_EQ(noise.size(), 1u);
        double sum = 0;
        for (const double v : noise[0].swapped.values) sum += v;
        const double moved = (value_of(halves.a, nullptr) - value_of(halves.b, nullptr)) / 2;
        EXPECT_NEAR(std::abs(sum), std::abs(moved), 2e-3 * std::abs(moved)) << metric << ": to first order";
    }
}

TEST(Noise, EqualHalvesChangeNothing) {
    const HostImage truth = truth_image({40, 30});
    Random random(3);
    const HostImage test = with_noise(truth, 0.2f, random);
    const Mask all = full_mask(truth.extent);
    for (const char* name : {"mse", "relmse"}) {
        ReferenceHalves halves = noisy_halves(truth, constant(truth.extent, 0), random);
        halves.guide = truth;
        const Score s = score(metric_reference(truth, halves, {name}, {}), test, std::span(&all, 1)).front();
        EXPECT_TRUE(s.corrected);
        EXPECT_NEAR(s.value / s.uncorrected, 1, 1e-12) << name;  // the same sum, in another association
        EXPECT_EQ(*s.low, s.value) << name;
        EXPECT_EQ(*s.floor, 0) << name;
        // With the truth as guide it is the metric of two images, whose formula has another name.
        const Score plain = score(metric_reference(truth, std::nullopt, {name}, {}), test, std::span(&all, 1)).front();
        EXPECT_NEAR(s.value / plain.value, 1, 1e-12) << name;
        EXPECT_EQ(plain.formula, metric_named(name).formula);
        EXPECT_EQ(s.formula == plain.formula, std::string(name) == "mse") << s.formula;
    }
}

TEST(Score, RowsHoldMetricsTimesMasks) {
    const HostImage truth = truth_image({40, 30});
    Random random(3);
    const ReferenceHalves halves = noisy_halves(truth, constant(truth.extent, 0.1), random);
    HostImage test = with_noise(truth, 0.1f, random);
    test.set_rgb(5, glm::vec3(NAN));
    std::vector<Mask> masks = {full_mask(truth.extent), full_mask(truth.extent)};
    masks[1].name = "none";
    masks[1].inside.assign(masks[1].inside.size(), 0);
    const MetricReference reference =
        metric_reference(mean_of(halves.a, halves.b), halves, {"mse", "flip", "bias"}, {});
    PixelCounts counts;
    const std::vector<Score> scores = score(reference, test, masks, &counts);
    ASSERT_EQ(scores.size(), 6u);
    EXPECT_EQ(counts.nan, 1u);
    EXPECT_EQ(scores[0].pixels, 40u * 30 - 1);
    EXPECT_EQ(scores[1].mask, "none");
    EXPECT_TRUE(std::isnan(scores[1].value));
    EXPECT_FALSE(scores[1].low);
    EXPECT_EQ(scores[2].metric->name, "flip");
    EXPECT_FALSE(scores[2].corrected);
    EXPECT_LE(*scores[2].low, scores[2].value);
    EXPECT_GE(*scores[2].high, scores[2].value);
    EXPECT_GT(*scores[2].floor, 0);
    EXPECT_TRUE(scores[4].low);
    EXPECT_THROW(metric_reference(truth, std::nullopt, {"msee"}, {}), Error);
    EXPECT_THROW(score(reference, HostImage({3, 3}, 3), masks), Error);
}
