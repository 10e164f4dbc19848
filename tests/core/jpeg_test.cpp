#include "core/jpeg.h"
#include "core/files.h"

#include <gtest/gtest.h>

namespace {

constexpr glm::uvec2 extent(18, 18);

std::optional<std::vector<uint8_t>> decode(const std::string& bytes, glm::uvec2 announced = extent) {
    return decode_jpeg_rgba({reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size()}, announced);
}

std::string file(const std::string& name) {
    return read_text(std::filesystem::path(SSRLAB_SOURCE_DIR) / "tests/data/fuzz/texture" / name);
}

}  // namespace

TEST(Jpeg, HasItsRowsFromTheTopAndOpaqueColors) {
    const auto baseline = decode(file("baseline.jpg"));
    ASSERT_TRUE(baseline);
    ASSERT_EQ(baseline->size(), 18u * 18 * 4);
    const auto corner = [&](size_t at) { return std::vector<int>(baseline->begin() + at, baseline->begin() + at + 4); };
    EXPECT_EQ(corner(0), (std::vector{3, 10, 20, 255}));  // as Pillow has them
    EXPECT_EQ(corner(baseline->size() - 4), (std::vector{218, 225, 235, 255}));
    EXPECT_EQ(decode(file("progressive.jpg")), baseline);  // the same coefficients
    const auto grey = decode(file("grey.jpg"));
    ASSERT_TRUE(grey);
    EXPECT_EQ((std::vector<int>(grey->end() - 4, grey->end())), (std::vector{216, 216, 216, 255}));
}

TEST(Jpeg, BrokenOnesAndThoseOfAnotherExtentAreNone) {
    for (const char* name : {"baseline.jpg", "progressive.jpg", "grey.jpg"}) {
        const std::string whole = file(name);
        for (size_t size = 0; size + 2 < whole.size(); size += 7) EXPECT_FALSE(decode(whole.substr(0, size))) << size;
        EXPECT_FALSE(decode(whole, {18, 17}));
    }
}
