#include "tests/variants/blue_noise_fixture.h"
#include "tests/variants/blue_noise_generator.h"
#include "tests/variants/blue_noise_spectrum.h"

#include <cmath>
#include <complex>
#include <map>
#include <numbers>

namespace {

constexpr size_t texel_count = 128 * 128;

glm::uvec2 code_at(const HostImage& table, size_t texel) {
    return {unsigned(std::lround(table.values[texel * 2] * 255)),
            unsigned(std::lround(table.values[texel * 2 + 1] * 255))};
}

// The table.

TEST(BlueNoiseTable, IsWhatTheGeneratorMakes) { EXPECT_EQ(make_blue_noise_table().values, blue_noise_table().values); }

TEST(BlueNoiseTexture, IsWhatTheGeneratorMakes) { EXPECT_EQ(make_blue_noise_texture(), blue_noise_texture()); }

TEST(BlueNoiseTable, HoldsEveryCodeEquallyOften) {
    const HostImage table = blue_noise_table();
    std::array<std::map<unsigned, size_t>, 2> counts;
    for (size_t texel = 0; texel < texel_count; ++texel)
        for (int channel = 0; channel < 2; ++channel) ++counts[channel][code_at(table, texel)[channel]];
    for (const auto& channel : counts) {
        ASSERT_EQ(channel.size(), 256u);
        for (const auto& [code, count] : channel) EXPECT_EQ(count, texel_count / 256) << code;
    }
}

/// Every box of 2^-a by 2^-(14 - a) holds one of the 2^14 pairs, so that the two numbers are independent, too.
TEST(BlueNoiseTable, FillsTheUnitSquareEvenly) {
    const HostImage table = blue_noise_table();
    for (const unsigned a : {6u, 7u, 8u}) {
        std::vector<unsigned> counts(texel_count);
        for (size_t texel = 0; texel < texel_count; ++texel) {
            const glm::uvec2 code = code_at(table, texel);
            ++counts[code.x >> (8 - a) << (14 - a) | code.y >> (a - 6)];
        }
        EXPECT_EQ(std::ranges::count(counts, 1u), std::ptrdiff_t(texel_count)) << a;
    }
}

// The pass.

struct BlueNoisePass : BlueNoiseTest {};

uint32_t hash(uint32_t x) {
    x = (x ^ x >> 16) * 0x7feb352du;
    x = (x ^ x >> 15) * 0x846ca68bu;
    return x ^ x >> 16;
}

/// The numbers in units of 2^-32, in 64-bit arithmetic: table code, frame and the seed's hashes.
std::vector<uint64_t> expected_numbers(unsigned frame, unsigned seed, NoiseShift shift) {
    const HostImage table = blue_noise_table();
    const double plastic = 1.32471795724474602596, golden = 1.61803398875;
    const bool is_diagonal = shift != NoiseShift::r2;
    const uint64_t start = shift == NoiseShift::golden_diagonal_from_half ? 1u << 31 : 0;
    const double shifts[2] = {is_diagonal ? golden - 1 : 1 / plastic, is_diagonal ? golden - 1 : 1 / plastic / plastic};
    std::vector<uint64_t> numbers;
    for (unsigned y = 0; y < 128; ++y)
        for (unsigned x = 0; x < 128; ++x) {
            const uint32_t move = seed ? hash(3 * seed + 2) : 0;
            const glm::uvec2 code = code_at(table, ((y + (move >> 16)) % 128) * 128 + (x + move) % 128);
            for (int d = 0; d < 2; ++d) {
                const uint64_t per_frame = uint64_t(shifts[d] * 4294967296.0);
                const uint64_t rotation = seed ? hash(3 * seed + unsigned(d)) : 0;
                numbers.push_back(((2 * code[d] + 1) * uint64_t(1 << 23) + start + frame % 256 * per_frame + rotation) %
                                  4294967296u);
            }
        }
    return numbers;
}

TEST_F(BlueNoisePass, MatchesTheFormulaExactly) {
    for (const NoiseShift shift : {NoiseShift::golden_diagonal, NoiseShift::golden_diagonal_from_half, NoiseShift::r2})
        for (const unsigned frame : {0u, 1u, 100u, 255u, 256u, 70001u})
            for (const unsigned seed : {0u, 1u, 2u, 0xfffffff0u}) {
                SCOPED_TRACE(testing::Message() << "frame " << frame << ", seed " << seed);
                const std::vector<uint64_t> expected = expected_numbers(frame, seed, shift);
                const HostImage fine = numbers(frame, seed, shift, NoisePrecision::float_32);
                const HostImage coarse = numbers(frame, seed, shift, NoisePrecision::bits_8);
                size_t wrong = 0;
                for (size_t i = 0; i < expected.size(); ++i) {
                    const double number = double(expected[i] >> 8) * 0x1p-24;  // what a float holds exactly
                    wrong += fine.values[i] != float(number);
                    wrong += std::lround(coarse.values[i] * 255) != std::lround(number * 255);
                }
                EXPECT_EQ(wrong, 0u);
            }
}

/// 16384 pairs of a frame: means, products of neighbours and of frames within five standard errors, one false alarm in
/// 100 000 each. Blue noise fails: its neighbours differ.
TEST_F(BlueNoisePass, WhiteNumbersAreIndependent) {
    const auto correlation = [&](const HostImage& a, const HostImage& b, size_t shift) {
        double sum = 0;
        for (size_t i = 0; i < a.values.size(); ++i)
            sum += (a.values[i] - 0.5) * (b.values[(i + shift) % b.values.size()] - 0.5);
        return sum / (double(a.values.size()) / 12);  // variance of a uniform number
    };
    const double five_errors = 5 / std::sqrt(2.0 * 128 * 128);
    for (const unsigned seed : {0u, 3u}) {
        const HostImage now = numbers(5, seed, NoiseShift::white, NoisePrecision::float_32),
                        next = numbers(6, seed, NoiseShift::white, NoisePrecision::float_32),
                        other = numbers(5, seed + 1, NoiseShift::white, NoisePrecision::float_32);
        double mean = 0;
        for (const float v : now.values) mean += v / double(now.values.size());
        EXPECT_NEAR(mean, 0.5, five_errors / std::sqrt(12.0));
        EXPECT_NEAR(correlation(now, now, 0), 1, 5 * std::sqrt(0.8 / double(now.values.size())));
        for (const size_t shift : {1, 2, 4, 256, 258})
            EXPECT_NEAR(correlation(now, now, shift), 0, five_errors) << shift;
        for (const size_t shift : {0, 1, 2}) {
            EXPECT_NEAR(correlation(now, next, shift), 0, five_errors);
            EXPECT_NEAR(correlation(now, other, shift), 0, five_errors);
        }
    }
    const HostImage blue = numbers(5, 0, NoiseShift::r2, NoisePrecision::float_32);
    EXPECT_GT(std::abs(correlation(blue, blue, 2)), five_errors);
}

TEST_F(BlueNoisePass, FloatNumbersLieBelowOneAndEightBitNumbersReachIt) {
    const HostImage fine = numbers(0, 0, NoiseShift::r2, NoisePrecision::float_32);
    const HostImage coarse = numbers(0, 0, NoiseShift::r2, NoisePrecision::bits_8);
    EXPECT_EQ(std::ranges::max(fine.values), 255.5f / 256);
    EXPECT_EQ(std::ranges::max(coarse.values), 1.0f);
    EXPECT_EQ(std::ranges::min(coarse.values), 0.0f);
}

TEST_F(BlueNoisePass, GivesTheSameNumbersAsADraw) {
    for (const NoiseShift shift : {NoiseShift::golden_diagonal_from_half, NoiseShift::r2})
        for (const NoisePrecision precision : {NoisePrecision::bits_8, NoisePrecision::float_32})
            for (const unsigned seed : {0u, 3u}) {
                begin(77, seed);
                const HostImage computed =
                    pass_list.download(noise.render(pass_list, shift, precision, NoiseStage::compute));
                pass_list.clear(
                    pass_list.image_of("blue_noise", precision == NoisePrecision::bits_8 ? Format::rg8 : Format::rg32f,
                                       {128, 128}),
                    {});
                const HostImage drawn =
                    pass_list.download(noise.render(pass_list, shift, precision, NoiseStage::fragment));
                EXPECT_EQ(drawn.values, computed.values) << int(shift) << ", seed " << seed;
            }
}

TEST_F(BlueNoisePass, ServesSeveralGraphs) {
    const HostImage first = numbers(5, 2, NoiseShift::r2);
    PassList other(device(), {4, 4});
    CameraData camera{};
    camera.frame = {5, 2, 0, 1};
    for (int repetition = 0; repetition < 2; ++repetition) {
        other.begin_frame(camera, no_parameters, {});
        EXPECT_EQ(other.download(noise.render(other, NoiseShift::r2)).values, first.values);
    }
    EXPECT_EQ(numbers(5, 2, NoiseShift::r2).values, first.values);
}

// Over time.

/// What one period of 256 frames does to every texel.
struct Period {
    double difference_changes = 0;               ///< greatest change of (u2 - u1) modulo 1 against frame 0
    std::array<unsigned, 64> visits_of_cells{};  ///< of texel 0, in 8x8 cells of the unit square
    double rms_mean_disk = 0;                    ///< over texels, of the mean over frames of a function with integral 0
};

struct BlueNoiseTime : BlueNoiseTest {
    Period period(NoiseShift shift) {
        Period result;
        const auto disk = number_functions()[3].value;
        const HostImage start = numbers(0, 0, shift, NoisePrecision::float_32);
        std::vector<double> sums(texel_count);
        for (unsigned frame = 0; frame < 256; ++frame) {
            const HostImage now = numbers(frame, 0, shift, NoisePrecision::float_32);
            for (size_t texel = 0; texel < texel_count; ++texel) {
                const double u1 = now.values[texel * 2], u2 = now.values[texel * 2 + 1];
                sums[texel] += disk(u1, u2);
                const double change = (u2 - u1) - (start.values[texel * 2 + 1] - start.values[texel * 2]);
                result.difference_changes = std::max(result.difference_changes, std::abs(change - std::round(change)));
                if (texel == 0) ++result.visits_of_cells[size_t(u1 * 8) * 8 + size_t(u2 * 8)];
            }
        }
        for (const double sum : sums) result.rms_mean_disk += sum / 256 * sum / 256 / texel_count;
        result.rms_mean_disk = std::sqrt(result.rms_mean_disk);
        return result;
    }
};

double chi_square(const std::array<unsigned, 64>& counts, double expected) {
    double sum = 0;
    for (const unsigned count : counts) sum += (count - expected) * (count - expected) / expected;
    return sum;
}

/// The original's defect: a texel's pairs stay on one diagonal, so that the mean over time is another one in every
/// texel.
TEST_F(BlueNoiseTime, GoldenDiagonalNeverLeavesTheDiagonal) {
    const Period p = period(NoiseShift::golden_diagonal);
    EXPECT_LT(p.difference_changes, 1e-6);  // the rounding of float32
    // A diagonal of the square passes 8 or 16 of the 64 cells: at best 16 pairs in each of 16.
    EXPECT_GE(chi_square(p.visits_of_cells, 4), 48 * 4 + 16 * 36);
    // |integral of sqrt(s) exp(2 pi i s) over [0, 1]| / sqrt(2), by quadrature. The mean of 256 steps is within 2 %.
    std::complex<double> integral = 0;
    for (int i = 0; i < 10000; ++i)
        integral += std::polar(std::sqrt((i + 0.5) / 1e4), 2 * std::numbers::pi * (i + 0.5) / 1e4) / 1e4;
    EXPECT_NEAR(p.rms_mean_disk, std::abs(integral) / std::sqrt(2.0), 0.02 * p.rms_mean_disk);
}

TEST_F(BlueNoiseTime, R2CoversTheSquare) {
    const Period p = period(NoiseShift::r2);
    EXPECT_GT(p.difference_changes, 0.49);
    // Random pairs would stay below 103.4 in 99.9 % of all cases (63 degrees of freedom), and below 37.8 in 0.5 %.
    EXPECT_LT(chi_square(p.visits_of_cells, 4), 37.8);
    // Of 256 random pairs the mean has a standard deviation of 0.5 / 16 = 0.031; the diagonal's error is 0.087.
    EXPECT_LT(p.rms_mean_disk, 0.031 / 3);
}

// Over seeds.

struct BlueNoiseSeeds : BlueNoiseTest {
    static constexpr unsigned count = 64;

    std::vector<HostImage> images_of_seeds() {
        std::vector<HostImage> images;
        for (unsigned seed = 0; seed < count; ++seed) images.push_back(numbers(9, seed, NoiseShift::golden_diagonal));
        return images;
    }
};

double correlation(const HostImage& a, int channel_a, const HostImage& b, int channel_b) {
    double sum_a = 0, sum_b = 0, sum_aa = 0, sum_bb = 0, sum_ab = 0;
    for (size_t texel = 0; texel < texel_count; ++texel) {
        const double u = a.values[texel * 2 + size_t(channel_a)], v = b.values[texel * 2 + size_t(channel_b)];
        sum_a += u, sum_b += v, sum_aa += u * u, sum_bb += v * v, sum_ab += u * v;
    }
    const double n = texel_count;
    return (sum_ab - sum_a * sum_b / n) / std::sqrt((sum_aa - sum_a * sum_a / n) * (sum_bb - sum_b * sum_b / n));
}

TEST_F(BlueNoiseSeeds, AreUncorrelated) {
    const std::vector<HostImage> images = images_of_seeds();
    double worst = 0;
    for (unsigned a = 0; a < 16; ++a)
        for (unsigned b = 0; b < a; ++b)
            for (int channels = 0; channels < 4; ++channels)
                worst = std::max(worst, std::abs(correlation(images[a], channels & 1, images[b], channels >> 1)));
    // Of 128^2 white texels the correlation has a standard deviation of 1 / 128; the energy of blue noise is held by
    // half as many frequencies, which makes it 1.4 / 128. 5 of these: a false alarm in 480 / 1.7e6 of all tables.
    EXPECT_LT(worst, 5 * 1.4 / 128);
    EXPECT_GT(correlation(images[3], 0, numbers(9, 3, NoiseShift::golden_diagonal), 0), 0.999);
}

/// The mean square error of an integral over n seeds must be the nth part of that over one.
TEST_F(BlueNoiseSeeds, AverageAsIndependentEstimates) {
    const std::vector<HostImage> images = images_of_seeds();
    const auto disk = number_functions()[3].value;  // with mean 0 and variance 1/4 over the square
    for (const unsigned n : {4u, 16u, 64u}) {
        double mean_square = 0;
        for (size_t i = 0; i < texel_count; ++i) {
            double sum = 0;
            for (unsigned seed = 0; seed < n; ++seed)
                sum += disk(images[seed].values[i * 2], images[seed].values[i * 2 + 1]);
            mean_square += sum / n * sum / n / texel_count;
        }
        // The sum of n^2 correlations, each 1.4 / 128 as above, over n: 1.5 % for all n. 5 of these: one false
        // alarm in a million for each n.
        EXPECT_NEAR(mean_square / (0.25 / n), 1.0, 0.08) << n;
    }
}

/// One texel's pairs over many seeds are uniform over the square, and its two numbers independent.
TEST_F(BlueNoiseSeeds, AreUniformInEveryTexel) {
    std::map<size_t, std::array<unsigned, 64>> counts;
    const unsigned seeds = 640;
    for (unsigned seed = 0; seed < seeds; ++seed) {
        const HostImage image = numbers(0, seed, NoiseShift::golden_diagonal, NoisePrecision::float_32);
        for (const size_t texel : {size_t(0), size_t(77), size_t(5000), texel_count - 1})
            ++counts[texel][size_t(image.values[texel * 2] * 8) * 8 + size_t(image.values[texel * 2 + 1] * 8)];
    }
    // Chi square with 63 degrees of freedom passes 131 once in a million.
    for (const auto& [texel, cells] : counts) EXPECT_LT(chi_square(cells, seeds / 64.0), 131) << texel;
}

}  // namespace

TEST(BlueNoiseTexture, IsUniformAndBlueInEachChannel) {
    const int width = blue_noise_texture_width;
    const std::vector<uint8_t> texels = blue_noise_texture();
    ASSERT_EQ(texels.size(), size_t(4 * width * width));
    for (int channel = 0; channel < 4; ++channel) {
        std::vector<int> count(256);
        for (int i = 0; i < width * width; ++i) ++count[texels[4 * i + channel]];
        EXPECT_TRUE(std::ranges::all_of(count, [](int n) { return n == 16; })) << channel;
        // Variance of means over 4x4 texels, and correlation with the other channels. Of white noise the former is a
        // 16th of a texel's, with a standard error of 9 % (256 means); the latter is 0, with one of 1 / 64.
        double of_means = 0;
        for (int y = 0; y < width; y += 4)
            for (int x = 0; x < width; x += 4) {
                double mean = 0;
                for (int i = 0; i < 16; ++i)
                    mean += texels[4 * ((y + i / 4) * width + x + i % 4) + channel] / 16.0 - 127.5 / 16;
                of_means += mean * mean / 256;
            }
        const double of_texels = (256.0 * 256 - 1) / 12;
        EXPECT_LT(of_means, 0.25 * of_texels / 16) << channel;  // eight standard errors below white noise
        for (int other = 0; other < channel; ++other) {
            double correlation = 0;
            for (int i = 0; i < width * width; ++i)
                correlation += (texels[4 * i + channel] - 127.5) * (texels[4 * i + other] - 127.5);
            EXPECT_LT(std::abs(correlation / (width * width) / of_texels), 5.0 / 64) << channel << ", " << other;
        }
    }
}
