#include "core/jpeg.h"
#include "core/error.h"
#include "core/files.h"
#include "tests/error_message.h"

#include <gtest/gtest.h>

namespace {

DecodedImage decode(const std::string& bytes) {
    return decode_jpeg({{reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size()}, "image 0", "a b.jpg"}, 1000);
}

std::string message(const std::string& bytes) {
    return error_message([&] { decode(bytes); });
}

std::string file(const std::string& name) {
    return read_text(std::filesystem::path(SSRLAB_SOURCE_DIR) / "tests/data/fuzz/texture" / name);
}

std::string segment(char marker, const std::string& data) {
    const size_t length = data.size() + 2;
    return std::string{'\xFF', marker, char(length >> 8), char(length)} + data;
}

/// A frame of 8 x 8 pixels, all coefficients 0, with tables of one code each (ITU-T T.81, annex B). `space`: "Adobe\0"
/// and what follows it, or "".
std::string frame(char start_of_frame, char bits, char components, const std::string& space = "") {
    std::string frame = std::string("\xFF\xD8", 2) + (space.empty() ? "" : segment('\xEE', space)) +
                        segment('\xDB', '\0' + std::string(64, '\1')),
                of_frame{bits, 0, 8, 0, 8, components}, of_scan{components};
    for (char c = 1; c <= components; ++c) of_frame += std::string{c, 0x11, 0}, of_scan += std::string{c, 0};
    const std::string one_code = '\1' + std::string(15, '\0') + '\0';
    return frame + segment(start_of_frame, of_frame) + segment('\xC4', '\0' + one_code) +
           segment('\xC4', '\x10' + one_code) + segment('\xDA', of_scan + std::string("\0\x3F\0", 3)) +
           std::string("\0\xFF\xD9", 3);
}

std::string adobe(char transform) { return std::string("Adobe\0\x64\0\0\0\0", 11) + transform; }

}  // namespace

TEST(Jpeg, HasItsRowsFromTheTopAndOpaqueColors) {
    const std::vector<uint8_t> baseline = decode(file("baseline.jpg")).rgba;
    ASSERT_EQ(baseline.size(), 18u * 18 * 4);
    const auto corner = [&](size_t at) { return std::vector<int>(baseline.begin() + at, baseline.begin() + at + 4); };
    EXPECT_EQ(corner(0), (std::vector{3, 10, 20, 255}));  // as Pillow has them
    EXPECT_EQ(corner(baseline.size() - 4), (std::vector{218, 225, 235, 255}));
    EXPECT_EQ(decode(file("progressive.jpg")).rgba, baseline);  // the same coefficients
    const DecodedImage grey = decode(file("grey.jpg"));
    EXPECT_EQ((std::vector<int>(grey.rgba.end() - 4, grey.rgba.end())), (std::vector{216, 216, 216, 255}));
    EXPECT_TRUE(grey.warnings.empty());
    const std::vector<uint8_t> arithmetic = decode(file("arithmetic.jpg")).rgba;  // of one colour but for a red corner
    for (const auto& [channel, code] : {std::pair(0, 188), {1, 110}, {2, 84}})
        EXPECT_NEAR(arithmetic[28 + channel], code, 4);
    for (const char components : {1, 3}) {
        const std::vector<uint8_t> middle_grey = decode(frame('\xC0', 8, components)).rgba;
        for (size_t i = 0; i < middle_grey.size(); ++i) ASSERT_EQ(middle_grey[i], i % 4 == 3 ? 255 : 128);
    }
}

TEST(Jpeg, ThatIsCutIsRefused) {
    for (const char* name : {"baseline.jpg", "progressive.jpg", "grey.jpg"}) {
        const std::string whole = file(name);
        for (size_t size = 0; size + 2 < whole.size(); ++size)
            ASSERT_NE(message(whole.substr(0, size)).find("image 0 cannot be decoded"), std::string::npos)
                << name << size;
    }
    EXPECT_NE(message(file("baseline.jpg").substr(0, 500)).find("as a JPEG it is broken: "), std::string::npos);
}

/// What cameras and editors leave between the picture and its end, and what was lost of the end, is no part of it.
TEST(Jpeg, WithHarmlessFaultsIsReadWithAWarning) {
    for (const char* name : {"baseline.jpg", "progressive.jpg", "grey.jpg"}) {
        const std::string whole = file(name), data = whole.substr(0, whole.size() - 2);
        const std::vector<uint8_t> rgba = decode(whole).rgba;
        const DecodedImage extra = decode(data + std::string(64, '\0') + "\xFF\xD9"), endless = decode(data);
        EXPECT_EQ(extra.rgba, rgba);
        ASSERT_EQ(extra.warnings.size(), 1u) << name;
        EXPECT_NE(extra.warnings[0].find("extraneous bytes before marker 0xd9"), std::string::npos)
            << extra.warnings[0];
        EXPECT_EQ(endless.rgba, rgba);
        ASSERT_EQ(endless.warnings.size(), 1u) << name;
        EXPECT_NE(endless.warnings[0].find("its end is missing"), std::string::npos);
    }
}

TEST(Jpeg, OfKindsThatAreNotReadSaysWhichAndHowToConvertIt) {
    for (const auto& [transform, kind] :
         {std::pair('\0', "4 components (CMYK)"), {'\2', "4 components (CMYK as YCCK)"}})
        EXPECT_EQ(message(frame('\xC0', 8, 4, adobe(transform))),
                  std::string("image 0 cannot be decoded: it is a JPEG of ") + kind +
                      ", of which no RGB can be made without a profile; convert it: convert 'a b.jpg' -colorspace sRGB "
                      "'a b.png'");
    EXPECT_NE(message(frame('\xC1', 12, 3))
                  .find("it is a JPEG of 12 bits, of which 8 are read; convert it: djpeg 'a b.jpg' |"),
              std::string::npos);
    EXPECT_NE(message(frame('\xC3', 8, 3)).find("it is a lossless JPEG; convert it: djpeg"), std::string::npos);
    EXPECT_NE(message(frame('\xC5', 8, 3)).find("it is a hierarchical JPEG"), std::string::npos);
}
