#include "core/scene/latlong_image.h"
#include "core/error.h"
#include "core/exr/exr.h"
#include "core/scene/scene.h"
#include "tests/error_message.h"
#include "tests/exr_writer.h"

#include <ImfChromaticitiesAttribute.h>
#include <ImfStandardAttributes.h>
#include <gtest/gtest.h>

namespace fs = std::filesystem;

namespace {

struct LatlongImages : testing::Test {
    fs::path folder = fs::temp_directory_path() / "latlong";
    fs::path file = folder / "sky.exr";
    std::vector<std::string> notes;

    void SetUp() override {
        fs::remove_all(folder);
        fs::create_directories(folder);
    }
    void TearDown() override { fs::remove_all(folder); }
};

}  // namespace

TEST_F(LatlongImages, PanoramasAreTwiceAsWideAsHigh) {
    const auto read = [&](unsigned width, unsigned height) {
        write_exr(file, HostImage({width, height}, 3, 0.5f));
        return error_message([&] { EXPECT_EQ(read_latlong(file, 2, notes).rgb(0), glm::vec3(1)); });
    };
    for (const glm::uvec2 size :
         {glm::uvec2(64, 32), {1001, 500}, {101, 51}, {100, 49}, {63, 32}, {1, 1}, {8, 4}, {3, 1}})
        EXPECT_EQ(read(size.x, size.y), "no error") << size.x;
    for (const auto& [size, said] : {std::pair(glm::uvec2(64, 64), "has 64 x 64 pixels; it may be an angular map"),
                                     {glm::uvec2(16, 96), "`exrenvmap -l -ci -w 64 cube.exr latlong.exr`"},
                                     {glm::uvec2(96, 16), "`exrenvmap -l -w 64 face%.exr latlong.exr`"},
                                     {glm::uvec2(64, 48), "as a cross"},
                                     {glm::uvec2(48, 64), "as a cross"},
                                     {glm::uvec2(64, 16), "a part of a panorama"},
                                     {glm::uvec2(2, 2), "twice as wide as high"}})
        EXPECT_NE(read(size.x, size.y).find(said), std::string::npos) << read(size.x, size.y);
    EXPECT_TRUE(notes.empty());
}

/// A black ground that a compositor cropped stays ground: the panorama is the display window.
TEST_F(LatlongImages, CroppedPanoramasKeepTheirPlace) {
    ExrContent sky(32, 16);
    sky.data.max.y = 7;
    sky.add("", "rgb", {1, 0.5, 0.25});
    sky.write(file);
    const Environment environment{.type = Environment::Type::image, .latlong = read_latlong(file, 1, notes)};
    EXPECT_EQ(environment.radiance({0, 1, 0}), glm::vec3(1, 0.5f, 0.25f));
    EXPECT_EQ(environment.radiance({0, -1, 0}), glm::vec3(0));
}

TEST_F(LatlongImages, ColoursOutsideOfRec709AreSaid) {
    ExrContent green(4, 2);
    green.add("", "RGB", {0, 1, 0});
    green.change = [](Imf::Header& header) {
        Imf::addChromaticities(header, {{0.708f, 0.292f}, {0.170f, 0.797f}, {0.131f, 0.046f}, {0.3127f, 0.3290f}});
    };
    green.write(file);
    const HostImage image = read_latlong(file, 1, notes);
    // The inverse of ITU-R BT.2087-0's matrix has (-0.5876, 1.1329, -0.1006) there.
    EXPECT_EQ(image.rgb(0).x, 0);
    EXPECT_NEAR(image.rgb(0).y, 1.1329f, 1e-4f);
    EXPECT_EQ(image.rgb(0).z, 0);
    ASSERT_EQ(notes.size(), 2u);
    EXPECT_NE(notes[0].find("Rec. 2020"), std::string::npos);
    EXPECT_NE(notes[1].find("8 texels have a colour outside of Rec. 709"), std::string::npos);
    green.channels.clear();
    green.add("", "RGB", {-1, -1, -1}), green.write(file);
    EXPECT_NE(error_message([&] { read_latlong(file, 1, notes); }).find("must be finite and not negative"),
              std::string::npos);
}
