#include "tests/variants/blue_noise_spectrum.h"
#include "tests/variants/blue_noise_fixture.h"
#include "tests/variants/golden_vectors.h"

#include <random>

// The noise is to be of the same kind as that of AMD FidelityFX SSSR 1.5, whose table carries no licence and is not
// here: its spectra are.

namespace {

using Spectra = std::array<BandEnergies, 4>;  // of number_functions()

/// Of the numbers that the original's noise pass wrote in frame 0, where its table is seen as it is.
constexpr Spectra original_table = {{{0.0022, 0.0041, 0.0141, 0.0690, 0.9019, 1.3801},
                                     {0.0021, 0.0040, 0.0126, 0.0733, 0.9142, 1.3743},
                                     {0.0606, 0.0851, 0.2572, 0.7634, 1.2433, 1.0909},
                                     {0.0282, 0.0472, 0.1334, 0.4830, 1.1807, 1.1782}}};

/// Means over its frames 1 to 5: where a rotation wraps numbers around, the table is less blue.
constexpr Spectra original_rotated = {{{0.2487, 0.3042, 0.4331, 0.7046, 1.1099, 1.1208},
                                       {0.2642, 0.2919, 0.4362, 0.6950, 1.0942, 1.1292},
                                       {0.4616, 0.6218, 0.8215, 1.0253, 1.0752, 1.0189},
                                       {0.0629, 0.0863, 0.1785, 0.4630, 1.0986, 1.2089}}};

/// Two noises count as of one kind if no band differs by more than 3 dB. The smallest band holds 98 independent
/// frequencies, so that realisations of one process differ by 0.6 dB there; white noise is off by 26 dB and 6 dB.
constexpr double allowed_ratio = 2;

Spectra spectra(const HostImage& numbers) {
    Spectra result;
    for (size_t f = 0; f < result.size(); ++f) result[f] = band_energies(numbers, number_functions()[f]);
    return result;
}

Spectra mean(const std::vector<HostImage>& images) {
    Spectra sum{};
    for (const HostImage& numbers : images) {
        const Spectra one = spectra(numbers);
        for (size_t f = 0; f < one.size(); ++f)
            for (size_t band = 0; band < one[f].size(); ++band) sum[f][band] += one[f][band] / double(images.size());
    }
    return sum;
}

/// The greatest ratio, either way, between two spectra of function `f`, over all bands.
double worst_ratio(const Spectra& a, const Spectra& b, size_t f) {
    double worst = 1;
    for (size_t band = 0; band < a[f].size(); ++band)
        worst = std::max({worst, a[f][band] / b[f][band], b[f][band] / a[f][band]});
    return worst;
}

void expect_same_kind(const HostImage& ours, const Spectra& original) {
    const Spectra found = spectra(ours);
    for (size_t f = 0; f < found.size(); ++f)
        EXPECT_LT(worst_ratio(found, original, f), allowed_ratio) << number_functions()[f].name;
}

HostImage white_noise(unsigned seed) {
    std::mt19937 random(seed);
    HostImage numbers({128, 128}, 2);
    for (float& u : numbers.values) u = float(random() >> 8) * 0x1p-24f;
    return numbers;
}

struct BlueNoiseSpectrum : BlueNoiseTest {};

TEST_F(BlueNoiseSpectrum, WhiteNoiseHasEqualEnergyInEveryBand) {
    const Spectra found = spectra(white_noise(1));
    // The smallest band's mean over 98 exponentially distributed powers has a standard deviation of 0.10: 5 of them,
    // which such a mean, a gamma variable, exceeds once in 2 * 10^5.
    for (const BandEnergies& energies : found)
        for (const double energy : energies) EXPECT_NEAR(energy, 1.0, 0.5);
}

/// But for the product of rotated numbers, where the original is nearly white.
TEST_F(BlueNoiseSpectrum, TellsWhiteNoiseFromTheOriginal) {
    const Spectra white = spectra(white_noise(2));
    for (const size_t f : {0, 1, 2, 3}) {
        EXPECT_GT(worst_ratio(white, original_table, f), 2 * allowed_ratio) << number_functions()[f].name;
    }
    for (const size_t f : {0, 1, 3}) {
        EXPECT_GT(worst_ratio(white, original_rotated, f), allowed_ratio) << number_functions()[f].name;
    }
}

TEST_F(BlueNoiseSpectrum, OfTheTableIsThatOfTheOriginal) {
    expect_same_kind(numbers(0, 0, NoiseShift::golden_diagonal), original_table);
}

TEST_F(BlueNoiseSpectrum, KeepsLowFrequenciesBelowOnePercent) {
    for (size_t f : {0, 1}) {
        const BandEnergies energies = band_energies(blue_noise_table(), number_functions()[f]);
        // -20 dB up to 3/16 cycle per texel, as in the original; white noise has 1.
        for (size_t band = 0; band < 3; ++band) EXPECT_LT(energies[band], 0.01) << band;
    }
}

TEST_F(BlueNoiseSpectrum, OfRotatedNumbersIsThatOfTheOriginal) {
    for (const NoiseShift shift : {NoiseShift::golden_diagonal, NoiseShift::r2})
        for (const unsigned seed : {0u, 7u}) {
            SCOPED_TRACE(testing::Message() << "shift " << int(shift) << ", seed " << seed);
            std::vector<HostImage> frames;
            for (unsigned frame = 1; frame <= 5; ++frame) frames.push_back(numbers(frame, seed, shift));
            const Spectra found = mean(frames);
            for (size_t f = 0; f < found.size(); ++f)
                EXPECT_LT(worst_ratio(found, original_rotated, f), allowed_ratio) << number_functions()[f].name;
        }
}

// Against the recorded numbers themselves, and the formula of the animation.

std::vector<std::string> recorded_noises() {
    std::vector<std::string> files = golden_files("amd/");
    std::erase_if(files, [](const std::string& file) { return !file.ends_with("/noise.exr"); });
    return files;
}

HostImage recorded_numbers(const std::string& file) { return golden_layer(read_golden(file), "U"); }

/// Sets of one frame say so in their meta.json; of several, in its entry for the folder of the frame ("f3").
unsigned frame_of(const std::string& file) {
    const std::filesystem::path folder = std::filesystem::path(file).parent_path();
    if (is_golden((folder / "meta.json").string())) return golden_meta(folder.string())["frame_index_for_noise"];
    const unsigned number = unsigned(std::stoul(folder.filename().string().substr(1)));
    const nlohmann::json meta = golden_meta(folder.parent_path().string());
    for (const nlohmann::json& frame : meta["frames"])
        if (frame["frame"] == number) return frame["noise_frame_index"];
    throw std::runtime_error("no entry for the frame of " + file);
}

struct RecordedNoise : BlueNoiseTest, testing::WithParamInterface<std::string> {};
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(RecordedNoise);  // GoldenVectors says where they must be

TEST_P(RecordedNoise, HasTheSpectrumOfOurs) {
    expect_same_kind(numbers(frame_of(GetParam()), 0, NoiseShift::golden_diagonal),
                     spectra(recorded_numbers(GetParam())));
}

/// The figures above are rounded to 1e-4, and the least of them is 2e-3; those of rotated numbers are means.
TEST_P(RecordedNoise, HasTheSpectraThatOursIsTestedAgainst) {
    const bool is_table = frame_of(GetParam()) == 0;
    const Spectra found = spectra(recorded_numbers(GetParam()));
    for (size_t f = 0; f < found.size(); ++f) {
        EXPECT_LT(worst_ratio(found, is_table ? original_table : original_rotated, f), is_table ? 1.03 : 1.4);
    }
}

/// In frame 0 number and code are the same, so that any recorded frame 0 serves as the original's table.
TEST_P(RecordedNoise, IsWhatOurPassMakesOfTheOriginalTable) {
    const std::vector<std::string> files = recorded_noises();
    const auto first = std::ranges::find(files, 0u, frame_of);
    ASSERT_NE(first, files.end()) << "no frame 0 among the recorded";
    begin(frame_of(GetParam()), 0);
    noise.render(pass_list, NoiseShift::golden_diagonal);  // makes the images; then the table is exchanged
    pass_list.upload(pass_list.image_of("blue_noise_table", Format::rg8, {128, 128}), recorded_numbers(*first));
    const HostImage made = pass_list.download(noise.render(pass_list, NoiseShift::golden_diagonal));
    EXPECT_EQ(made.values, recorded_numbers(GetParam()).values);
}

INSTANTIATE_TEST_SUITE_P(golden_amd_noise, RecordedNoise, testing::ValuesIn(recorded_noises()),
                         [](const auto& info) { return golden_test_name(info.param); });

}  // namespace
