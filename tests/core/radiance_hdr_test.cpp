#include "core/radiance_hdr.h"
#include "core/error.h"
#include "core/exr/radiance_file.h"
#include "core/files.h"
#include "tests/error_message.h"
#include "tests/png_writer.h"
#include "tests/reading_limits.h"

#include <gtest/gtest.h>
#include <array>
#include <cmath>

namespace fs = std::filesystem;

namespace {

using Texel = std::array<uint8_t, 4>;

struct Radiance : testing::Test {
    fs::path folder = fs::temp_directory_path() / "radiance_test";
    std::vector<std::string> notes;

    void SetUp() override { fs::create_directories(folder); }
    void TearDown() override { fs::remove_all(folder); }

    HostImage read(const std::string& bytes) {
        write_text(folder / "a.hdr", bytes);
        notes.clear();
        return read_radiance(folder / "a.hdr", "", notes);
    }
    std::string message(const std::string& bytes) {
        return error_message([&] { read(bytes); });
    }
};

std::string header(const std::string& variables, const std::string& resolution) {
    return "#?RADIANCE\n# a comment\n" + variables + "\n" + resolution + "\n";
}

const std::string rgbe = "FORMAT=32-bit_rle_rgbe\n";

std::string bytes_of(std::initializer_list<Texel> texels) {
    std::string bytes;
    for (const Texel& texel : texels) bytes.append(texel.begin(), texel.end());
    return bytes;
}

/// m 2^(e - 136).
float value(unsigned mantissa, unsigned exponent) { return std::ldexp(float(mantissa), int(exponent) - 136); }

void expect_color(glm::vec3 seen, glm::vec3 expected) {
    for (int c = 0; c < 3; ++c) EXPECT_FLOAT_EQ(seen[c], expected[c]) << c;
}

}  // namespace

TEST_F(Radiance, TexelsAreMantissasTimesAPowerOfTwo) {
    const HostImage image =
        read(header(rgbe, "-Y 1 +X 3") + bytes_of({{128, 64, 255, 129}, {200, 0, 1, 255}, {9, 9, 9, 0}}));
    expect_color(image.rgb(0), {1, 0.5f, 255 / 128.0f});
    expect_color(image.rgb(1), {value(200, 255), 0, value(1, 255)});
    expect_color(image.rgb(2), glm::vec3(0));
    EXPECT_TRUE(notes.empty());
}

/// The same line in the three encodings: plain, with repeats of the texel before, with runs of each channel. Widths
/// below 8 are never packed.
TEST_F(Radiance, EncodingsAreReadAlike) {
    std::string plain, repeated, packed = std::string("\2\2\1\x2C", 4);
    for (int x = 0; x < 300; ++x)
        plain += bytes_of({x < 290 ? Texel{10, 20, 30, 130} : Texel{uint8_t(x - 200), 5, 6, 131}});
    // 289 repeats are 33 + 1 * 256: two digits.
    repeated = bytes_of({{10, 20, 30, 130}, {1, 1, 1, 33}, {1, 1, 1, 1}}) + plain.substr(290 * 4);
    for (size_t channel = 0; channel < 4; ++channel) {
        const char first = plain[channel];
        packed += std::string{char(128 + 127), first, char(128 + 127), first, char(128 + 36), first, char(10)};
        for (size_t x = 290; x < 300; ++x) packed += plain[x * 4 + channel];
    }
    const std::string start = header(rgbe, "-Y 2 +X 300");
    const HostImage image = read(start + plain + plain);
    expect_color(image.rgb(299), {value(99, 131), value(5, 131), value(6, 131)});
    EXPECT_EQ(read(start + repeated + packed).values, image.values);
    EXPECT_EQ(read(start + packed + plain).values, image.values);
    const std::string whole = start + packed + repeated;
    EXPECT_EQ(read(whole).values, image.values);
    for (size_t size = 0; size < whole.size(); ++size) ASSERT_NE(message(whole.substr(0, size)), "no error") << size;
    EXPECT_NE(message(start + packed.substr(0, packed.size() - 1)).find("a.hdr as a Radiance picture: it is cut off"),
              std::string::npos);
    EXPECT_NE(message(header(rgbe, "-Y 1 +X 2") + bytes_of({{1, 1, 1, 2}})).find("longer than its width"),
              std::string::npos);
    EXPECT_NE(message(header(rgbe, "-Y 1 +X 2") + bytes_of({{5, 1, 1, 2}, {1, 1, 1, 2}})).find("longer than its width"),
              std::string::npos);
}

/// "Radiance File Formats": the axis that stands first is that of the lines, and its sign the way it runs; +Y is up.
TEST_F(Radiance, LiesAsItsResolutionSays) {
    const std::string texels =
        bytes_of({{1, 0, 0, 136}, {2, 0, 0, 136}, {3, 0, 0, 136}, {4, 0, 0, 136}, {5, 0, 0, 136}, {6, 0, 0, 136}});
    for (const auto& [resolution, expected] :
         std::vector<std::pair<std::string, std::vector<float>>>{{"-Y 2 +X 3", {1, 2, 3, 4, 5, 6}},
                                                                 {"-Y 2 -X 3", {3, 2, 1, 6, 5, 4}},
                                                                 {"+Y 2 +X 3", {4, 5, 6, 1, 2, 3}},
                                                                 {"+Y 2 -X 3", {6, 5, 4, 3, 2, 1}},
                                                                 {"+X 3 -Y 2", {1, 3, 5, 2, 4, 6}},
                                                                 {"-X 3 -Y 2", {5, 3, 1, 6, 4, 2}},
                                                                 {"+X 3 +Y 2", {2, 4, 6, 1, 3, 5}},
                                                                 {"-X 3 +Y 2", {6, 4, 2, 5, 3, 1}}}) {
        const HostImage image = read(header(rgbe, resolution) + texels);
        ASSERT_EQ(image.extent, glm::uvec2(3, 2)) << resolution;
        for (size_t i = 0; i < 6; ++i) EXPECT_EQ(image.rgb(i).x, expected[i]) << resolution << ' ' << i;
    }
    for (const std::string wrong : {"-Y 2 +Y 3", "-Y 2", "-Y 0 +X 3", "Y 2 X 3", "-Y 2 +X -3", ""})
        EXPECT_NE(message(header(rgbe, wrong) + texels).find("its resolution is '"), std::string::npos) << wrong;
}

TEST_F(Radiance, IsRadianceWhateverItsHeaderMultipliedIn) {
    const std::string texel = bytes_of({{128, 128, 128, 129}});
    expect_color(read(header("EXPOSURE=2\n" + rgbe + "EXPOSURE= 4.0\nCOLORCORR=1 0.5 2\n", "-Y 1 +X 1") + texel).rgb(0),
                 glm::vec3(1) / (8.0f * glm::vec3(1, 0.5f, 2)));
    ASSERT_EQ(notes.size(), 1u);
    EXPECT_NE(notes[0].find("a.hdr: the 8 4 16 of its EXPOSURE and COLORCORR were divided out"), std::string::npos)
        << notes[0];
    read(header(rgbe + "EXPOSURE=          1.0000000000000\nGAMMA=1.0\nSOFTWARE=x\n", "-Y 1 +X 1") + texel);
    EXPECT_TRUE(notes.empty());
    for (const std::string wrong : {"EXPOSURE=0\n", "EXPOSURE=-1\n", "EXPOSURE=x\n", "COLORCORR=1 2\n",
                                    "PRIMARIES=1 2 3\n", "GAMMA=2.2\n", "FORMAT=ascii\n"})
        EXPECT_NE(
            message(header(wrong, "-Y 1 +X 1") + texel).find("its header says '" + wrong.substr(0, wrong.size() - 1)),
            std::string::npos)
            << wrong;
}

/// XYZ of D65, and the primaries of Rec. 2020 (ITU-R BT.2407, 2.2).
TEST_F(Radiance, ColorsOfOtherSpacesAreConverted) {
    const HostImage white = read(header("FORMAT=32-bit_rle_xyze\n", "-Y 1 +X 1") + bytes_of({{243, 255, 255, 128}}));
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(white.rgb(0)[c], 255 / 256.0f, 0.1f);
    const glm::vec3 xyz = glm::vec3(243, 255, 255) / 256.0f;  // Rec. 709 of XYZ by IEC 61966-2-1
    EXPECT_NEAR(white.rgb(0).x, 3.2406f * xyz.x - 1.5372f * xyz.y - 0.4986f * xyz.z, 2e-4f);
    EXPECT_NEAR(white.rgb(0).z, 0.0557f * xyz.x - 0.2040f * xyz.y + 1.0570f * xyz.z, 2e-4f);
    ASSERT_EQ(notes.size(), 1u);
    const HostImage red =
        read(header(rgbe + "PRIMARIES=0.708 0.292 0.170 0.797 0.131 0.046 0.3127 0.3290\n", "-Y 1 +X 1") +
             bytes_of({{128, 0, 0, 129}}));
    const glm::vec3 expected(1.66049f, -0.12455f, -0.01815f);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(red.rgb(0)[c], expected[c], 1e-4f);
    ASSERT_EQ(notes.size(), 1u);
    EXPECT_NE(message(header(rgbe + "PRIMARIES=0 0 0 0 0 0 0 0\n", "-Y 1 +X 1") + bytes_of({{1, 2, 3, 4}}))
                  .find("its PRIMARIES span no"),
              std::string::npos);
}

TEST_F(Radiance, TakesNoMemoryThatItOnlyAnnounces) {
    const LimitsOf limits({.memory = 1'000'000});
    EXPECT_NE(message(header(rgbe, "-Y 300 +X 300")).find("a.hdr: its image of 300 x 300 pixels needs 1.08 MB"),
              std::string::npos);
    EXPECT_NE(message(header(rgbe, "-Y 999999999 +X 999999999")).find("--max-memory"), std::string::npos);
}

/// A name says nothing of what is in the file.
TEST_F(Radiance, FilesAreReadByTheirBytes) {
    EXPECT_NE(message(PngWriter{}.file()).find("a.hdr: it is a PNG, whose display codes are no radiance"),
              std::string::npos);
    EXPECT_NE(message("II*" + std::string(9, '\0')).find("it is a TIFF; convert it: oiiotool "), std::string::npos);
    write_text(folder / "a.exr", header(rgbe, "-Y 1 +X 1") + bytes_of({{128, 128, 128, 129}}));
    EXPECT_EQ(read_radiance(folder / "a.exr", "", notes).rgb(0), glm::vec3(1));
}
