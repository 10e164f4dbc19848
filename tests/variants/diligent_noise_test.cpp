#include "tests/variants/blue_noise_fixture.h"
#include "tests/variants/diligent_golden.h"

#include <cmath>
#include <map>

// Against the numbers that DiligentFX drew; its table carries no licence and is not here.

namespace {

/// Recorded noises and the index of their frames.
std::map<std::string, unsigned> recorded_noises() {
    std::map<std::string, unsigned> frames;
    for (const std::string& set : diligent_still_sets())
        if (is_golden(set + "/noise.exr")) frames[set + "/noise.exr"] = golden_meta(set)["frame_index"];
    for (const std::string& sequence : diligent_sequences())
        for (unsigned frame = 0; frame < diligent_frame_count(sequence); ++frame)
            if (const std::string file = diligent_frame_folder(sequence, frame) + "noise.exr"; is_golden(file))
                frames[file] = golden_meta(sequence)["frames"][frame]["frame_index"];
    return frames;
}

HostImage recorded_numbers(const std::string& file) { return golden_layer(read_golden(file), "U"); }

struct DiligentNoiseOf : BlueNoiseTest, testing::WithParamInterface<std::pair<const std::string, unsigned>> {
    HostImage drawn(unsigned frame) {
        begin(frame, 0);
        return pass_list.download(noise.render(pass_list, NoiseShift::golden_diagonal_from_half, NoisePrecision::bits_8,
                                               NoiseStage::fragment));
    }
};
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(DiligentNoiseOf);  // GoldenVectors says where they must be

/// In frame 0 numbers are those of the table, half the range later: number k stands for code k + 128 modulo 256.
HostImage table_from_frame_0(HostImage numbers) {
    for (float& number : numbers.values) number = float((std::lround(number * 255) + 128) % 256) / 255.0f;
    return numbers;
}

TEST_P(DiligentNoiseOf, IsWhatOurPassMakesOfTheOriginalTable) {
    const std::map<std::string, unsigned> files = recorded_noises();
    const auto first = std::ranges::find(files, 0u, &std::pair<const std::string, unsigned>::second);
    ASSERT_NE(first, files.end()) << "no frame 0 among the recorded";
    const auto [file, frame] = GetParam();
    drawn(frame);  // makes the images; then the table is exchanged
    pass_list.upload(pass_list.image_of("blue_noise_table", Format::rg8, {128, 128}),
                     table_from_frame_0(recorded_numbers(first->first)));
    EXPECT_EQ(drawn(frame).values, recorded_numbers(file).values);
}

INSTANTIATE_TEST_SUITE_P(golden_diligent_noise, DiligentNoiseOf, testing::ValuesIn(recorded_noises()),
                         [](const auto& info) { return golden_test_name(info.param.first); });

}  // namespace
