#include "core/exr/exr_picture.h"
#include "core/chromaticities.h"
#include "core/exr/exr.h"
#include "core/files.h"
#include "tests/error_message.h"
#include "tests/exr_writer.h"

#include <ImfArray.h>
#include <ImfChromaticitiesAttribute.h>
#include <ImfDeepScanLineOutputPart.h>
#include <ImfIntAttribute.h>
#include <ImfRgbaFile.h>
#include <ImfRgbaYca.h>
#include <ImfStandardAttributes.h>
#include <gtest/gtest.h>

namespace fs = std::filesystem;

namespace {

class ExrPictures : public testing::Test {
protected:
    fs::path folder = fs::temp_directory_path() / "exr_picture";
    fs::path file = folder / "a.exr";

    void SetUp() override {
        fs::remove_all(folder);
        fs::create_directories(folder);
    }
    void TearDown() override { fs::remove_all(folder); }

    /// The one colour that the file shows.
    glm::vec3 color(const std::string& layer = "") {
        const HostImage rgb = read_exr_picture(file, layer).rgb;
        for (size_t i = 1; i < rgb.pixel_count(); ++i) EXPECT_EQ(rgb.rgb(i), rgb.rgb(0));
        return rgb.rgb(0);
    }
    std::string refused(const std::string& layer = "") {
        return error_message([&] { read_exr_picture(file, layer); });
    }
};

void expect_near(glm::vec3 a, glm::vec3 b, float tolerance) {
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(a[c], b[c], tolerance);
}

const glm::vec3 amber(0.75f, 0.5f, 0.25f);

}  // namespace

TEST_F(ExrPictures, ChannelsAreChosenByName) {
    const std::pair<const char*, std::vector<std::string>> spellings[] = {
        {"", {"R", "G", "B"}},
        {"", {"r", "g", "b"}},
        {"", {".R", ".G", ".B"}},
        {"Ci", {"Ci.r", "Ci.g", "Ci.b"}},
        {"beauty", {"beauty.red", "beauty.green", "beauty.blue"}},
        {"a.b", {"a.b.Red", "a.b.G", "a.b.b"}},
        {"ViewLayer.Combined", {"ViewLayer.Combined.R", "ViewLayer.Combined.G", "ViewLayer.Combined.B"}},
        {"velocity", {"velocity.X", "velocity.Y", "velocity.Z"}},
        {"", {"x", "y", "z"}}};
    for (const auto& [layer, names] : spellings) {
        ExrContent content(4, 2);
        for (int c = 0; c < 3; ++c) content.add(names[size_t(c)], amber[c]);
        content.write(file);
        EXPECT_EQ(color(layer), amber) << names[0];
        EXPECT_EQ(color(), amber) << names[0];
        // Neither alpha nor what the alphabet has before, between or behind them changes that.
        for (const char* more : {"A", "a", "AO", "dzdx", "u", "v", "objectID", "Albedo.R", "Albedo.G", "forward.speed"})
            content.add(more, 9, Imf::HALF);
        content.write(file);
        EXPECT_EQ(color(layer), amber) << names[0];
    }
    ExrContent both(1, 1);  // capitals are colours by the format; small letters by custom
    both.add("", "RGB", {0.75, 0.5, 0.25}), both.add("", "rgb", {9, 9, 9});
    both.write(file);
    EXPECT_EQ(color(), amber);
}

TEST_F(ExrPictures, GreyIsOneChannel) {
    for (const std::string name : {"Y", "Z", "depth.V", "AO"}) {
        ExrContent content(3, 2);
        content.add(name, 0.5);
        content.write(file);
        EXPECT_EQ(color(), glm::vec3(0.5f)) << name;
        content.add("A", 1);
        if (name.size() > 1) continue;
        content.write(file);
        EXPECT_EQ(color(), glm::vec3(0.5f)) << name;
    }
    ExrContent content(3, 2);
    content.add("", "RGBZ", {0.75, 0.5, 0.25, 4});
    content.write(file);
    EXPECT_EQ(color("Z"), glm::vec3(4));
    EXPECT_EQ(color("specular"), amber);  // the only layer, without a name, is what any name means
    content.add("n.X", 1), content.add("n.Y", 2);
    content.write(file);
    EXPECT_EQ(color("n.Y"), glm::vec3(2));
    EXPECT_NE(refused("n").find("layer 'n' (X Y) is no colour: it has 2 channels"), std::string::npos) << refused("n");
    EXPECT_NE(refused("m").find("has no layer 'm'"), std::string::npos);
}

TEST_F(ExrPictures, WhatIsNotClearIsListed) {
    ExrContent content(2, 2);
    content.add("a.", "RGB", {1, 1, 1}), content.add("depth.Z", 2);
    content.write(file);
    const ExrPicture only = read_exr_picture(file);
    EXPECT_EQ(only.rgb.rgb(0), glm::vec3(1));
    ASSERT_EQ(only.notes.size(), 1u);
    EXPECT_NE(only.notes[0].find("taken from the layer 'a' (R G B)"), std::string::npos) << only.notes[0];
    content.add("b.", "RGBA", {2, 2, 2, 1});
    content.write(file);
    EXPECT_NE(refused().find("it has 'a' (R G B), 'b' (R G B A), 'depth' (Z); name one with --layer"),
              std::string::npos)
        << refused();
    content.add("image.", "RGB", {3, 3, 3});  // what a reference calls the camera's radiance
    content.write(file);
    EXPECT_EQ(color(), glm::vec3(3));
    ExrContent two(2, 2);
    two.add("", "RG", {1, 2});
    two.write(file);
    EXPECT_NE(refused().find("layer R G without a layer's name is no colour"), std::string::npos) << refused();
}

TEST_F(ExrPictures, TheDisplayWindowIsThePicture) {
    const auto value = [](int x, int y) { return 100 + x + 16 * y; };
    // Columns and rows of the data window: the picture's, within it, shifted, larger to all sides, beside it.
    const Imath::Box2i windows[] = {
        {{0, 0}, {7, 4}}, {{2, 1}, {5, 3}}, {{-3, 2}, {6, 9}}, {{-2, -3}, {11, 8}}, {{8, 0}, {15, 4}}};
    enum { scan_lines, mip_maps, rip_maps, part };
    for (int i = 0; i < 20; ++i) {
        const Imath::Box2i& data = windows[i % 5];
        const int kind = i / 5;
        ExrContent content(8, 5);
        const Imath::V2i shift = i % 2 == 0 ? Imath::V2i(-20, 1000) : Imath::V2i(0, 0);
        content.display.min += shift, content.display.max += shift;
        content.data = {data.min + shift, data.max + shift};
        content.order = i % 3 == 0 ? Imf::DECREASING_Y : Imf::INCREASING_Y;
        content.compression = kind == scan_lines ? Imf::ZIP_COMPRESSION : Imf::PIZ_COMPRESSION;
        for (const char* name : {"R", "G", "B", "A"})
            content.add(
                name, [&, name](int x, int y) { return value(x - shift.x, y - shift.y) + name[0]; }, Imf::HALF);
        content.part = kind == part ? "a part" : "";
        if (kind == scan_lines) content.write(file);
        if (kind == mip_maps) content.write_tiled(file, 3, Imf::MIPMAP_LEVELS);
        if (kind == rip_maps) content.write_tiled(file, 4, Imf::RIPMAP_LEVELS);
        if (kind == part) write_parts(file, {content});
        const HostImage rgb = read_exr_picture(file).rgb;
        ASSERT_EQ(rgb.extent, glm::uvec2(8, 5));
        for (int y = 0; y < 5; ++y)
            for (int x = 0; x < 8; ++x) {
                const bool is_stored = x >= data.min.x && x <= data.max.x && y >= data.min.y && y <= data.max.y;
                for (int c = 0; c < 3; ++c)
                    ASSERT_EQ(rgb.pixel(unsigned(x), unsigned(y))[c], is_stored ? value(x, y) + "RGB"[c] : 0)
                        << x << " " << y << " kind " << kind;
            }
    }
}

TEST_F(ExrPictures, EveryCompressionIsRead) {
    for (const auto compression :
         {Imf::NO_COMPRESSION, Imf::RLE_COMPRESSION, Imf::ZIPS_COMPRESSION, Imf::ZIP_COMPRESSION, Imf::PIZ_COMPRESSION,
          Imf::PXR24_COMPRESSION, Imf::B44_COMPRESSION, Imf::B44A_COMPRESSION, Imf::DWAA_COMPRESSION,
          Imf::DWAB_COMPRESSION}) {
        ExrContent content(40, 70);
        content.compression = compression;
        content.add("", "RGB", {0.75, 0.5, 0.25}, Imf::HALF);  // constants survive lossy ones
        content.write(file);
        const HostImage rgb = read_exr_picture(file).rgb;
        for (size_t i = 0; i < rgb.pixel_count(); ++i) expect_near(rgb.rgb(i), amber, 2e-3f);
    }
}

/// A sun of 1e6 ends at the largest half float.
TEST_F(ExrPictures, CompressionsThatChangeColoursAreSaid) {
    ExrContent content(40, 70);
    content.add("", "RGB", {0.75, 0.5, 0.25});
    content.add("R", [](int x, int y) { return x == 5 && y == 5 ? 1e6 : 0.75; });
    content.write(file);
    EXPECT_TRUE(read_exr_picture(file).notes.empty());
    content.compression = Imf::DWAA_COMPRESSION;
    content.write(file);
    const ExrPicture picture = read_exr_picture(file);
    ASSERT_EQ(picture.notes.size(), 1u);
    EXPECT_EQ(picture.notes[0], file.string() +
                                    ": its compression DWAA takes the channels R, G, B and Y for colours, "
                                    "changes them, and cuts them off at 65504. For exact values write it "
                                    "with ZIP, PIZ or without compression.");
    EXPECT_LE(picture.rgb.rgb(5 * 40 + 5).x, 65504);
}

/// ITU-R BT.2087-0, table 4: linear BT.2020 of linear BT.709.
TEST_F(ExrPictures, PrimariesBecomeRec709) {
    const glm::vec3 seen(0.8f, 0.1f, 0.05f);
    const glm::vec3 wide(0.6274040f * 0.8f + 0.3292820f * 0.1f + 0.0433136f * 0.05f,
                         0.0690970f * 0.8f + 0.9195400f * 0.1f + 0.0113612f * 0.05f,
                         0.0163916f * 0.8f + 0.0880132f * 0.1f + 0.8955950f * 0.05f);
    const auto write = [&](const std::string& prefix, const std::string& letters, glm::vec3 values,
                           const Imf::Chromaticities& space) {
        ExrContent content(2, 2);
        content.add(prefix, letters, {values.x, values.y, values.z});
        content.change = [&](Imf::Header& header) {
            Imf::addChromaticities(header, space), Imf::addWhiteLuminance(header, 100);
            header.insert("acesImageContainerFlag", Imf::IntAttribute(1));
        };
        content.write(file);
    };
    const Imf::Chromaticities rec2020({0.708f, 0.292f}, {0.170f, 0.797f}, {0.131f, 0.046f}, {0.3127f, 0.3290f});
    write("", "RGB", wide, rec2020);
    expect_near(color(), seen, 1e-6f);
    ASSERT_EQ(read_exr_picture(file).notes.size(), 1u);
    EXPECT_NE(read_exr_picture(file).notes[0].find("converted from Rec. 2020 to Rec. 709"), std::string::npos);
    write("n.", "XYZ", wide, rec2020);  // vectors are no colours
    EXPECT_EQ(color(), wide);
    const Imf::Chromaticities rounded({0.6402f, 0.3298f}, {0.3f, 0.6f}, {0.15f, 0.06f}, {0.313f, 0.329f});
    write("", "RGB", seen, rounded);
    EXPECT_EQ(color(), seen);
    EXPECT_TRUE(read_exr_picture(file).notes.empty());

    // CIE XYZ of Rec. 709's red, green and white (IEC 61966-2-1, annex F).
    const Imf::Chromaticities xyz({1, 0}, {0, 1}, {0, 0}, {1.0f / 3, 1.0f / 3});
    for (const auto& [tristimulus, rgb] : {std::pair(glm::vec3(0.4124f, 0.2126f, 0.0193f), glm::vec3(1, 0, 0)),
                                           {glm::vec3(0.3576f, 0.7152f, 0.1192f), glm::vec3(0, 1, 0)},
                                           {glm::vec3(0.9505f, 1.0f, 1.0890f), glm::vec3(1)}}) {
        write("", "RGB", tristimulus, xyz);
        expect_near(color(), rgb, 1e-3f);  // as many digits as the standard prints
    }
    // ACES (SMPTE ST 2065-1): its white is Rec. 709's, adapted; the matrix with Bradford's transform, as it is widely
    // printed, is 2.52169, -1.13413, -0.38756 / -0.27648, 1.37272, -0.09624 / -0.01538, -0.15298, 1.16835.
    const Imf::Chromaticities aces({0.7347f, 0.2653f}, {0, 1}, {0.0001f, -0.077f}, {0.32168f, 0.33767f});
    write("", "RGB", glm::vec3(1), aces);
    expect_near(color(), glm::vec3(1), 1e-6f);
    write("", "RGB", {0.25f, 0.5f, 0.125f}, aces);
    expect_near(color(),
                {0.25f * 2.52169f - 0.5f * 1.13413f - 0.125f * 0.38756f,
                 -0.25f * 0.27648f + 0.5f * 1.37272f - 0.125f * 0.09624f,
                 -0.25f * 0.01538f - 0.5f * 0.15298f + 0.125f * 1.16835f},
                1e-4f);
    write("", "RGB", seen, {{0.3f, 0.3f}, {0.3f, 0.3f}, {0.3f, 0.3f}, {0.3f, 0.3f}});
    EXPECT_NE(refused().find("'chromaticities' spans no colours: red (0.3, 0.3)"), std::string::npos) << refused();
}

TEST_F(ExrPictures, LuminanceAndChromaBecomeColours) {
    // RY = (R - Y) / Y with Y of Rec. 709's weights, which round to 0.2126, 0.7152, 0.0722.
    const glm::vec3 seen(0.8f, 0.4f, 0.2f);
    const double y = 0.212639 * 0.8 + 0.715169 * 0.4 + 0.072192 * 0.2;
    ExrContent content(4, 4);
    content.add("Y", y), content.add("RY", (0.8 - y) / y), content.add("BY", (0.2 - y) / y);
    content.write(file);
    expect_near(color(), seen, 2e-5f);
    // Chroma for two by two pixels, as OpenEXR writes it, is read as OpenEXR does.
    std::vector<Imf::Rgba> pixels(20 * 12, Imf::Rgba(0.8f, 0.4f, 0.2f));
    {
        Imf::RgbaOutputFile out(file.c_str(), 20, 12, Imf::WRITE_YC);
        out.setFrameBuffer(pixels.data(), 1, 20);
        out.setYCRounding(10, 10);  // bits; less by default
        out.writePixels(12);
    }
    const HostImage rgb = read_exr_picture(file).rgb;
    ASSERT_EQ(rgb.extent, glm::uvec2(20, 12));
    for (size_t i = 0; i < rgb.pixel_count(); ++i) expect_near(rgb.rgb(i), seen, 4e-3f);  // four roundings to halves
    EXPECT_NE(refused("RY").find("'RY' is subsampled (2 x 2)"), std::string::npos) << refused("RY");
}

TEST_F(ExrPictures, PartsAreFoundByNameOrByTheirColours) {
    ExrContent depth(4, 2), beauty(4, 2), left(4, 2);
    depth.part = "depth", beauty.part = "beauty", left.part = "rgba.left";
    depth.add("Z", 4), depth.add("extra.R", 1), beauty.add("", "RGBA", {0.75, 0.5, 0.25, 1}, Imf::HALF);
    left.add("", "RGB", {3, 3, 3});
    left.change = [](Imf::Header& header) { header.setView("left"); };
    write_parts(file, {depth, beauty, left});
    EXPECT_EQ(color(), amber);
    EXPECT_EQ(color("beauty"), amber);
    EXPECT_EQ(color("depth"), glm::vec3(4));
    EXPECT_EQ(color("depth.Z"), glm::vec3(4));
    EXPECT_EQ(color("depth.extra"), glm::vec3(1));
    EXPECT_EQ(color("left"), glm::vec3(3));
    EXPECT_EQ(color("rgba.left"), glm::vec3(3));
    EXPECT_NE(refused("beaty").find("has no layer 'beaty'; did you mean 'beauty'?"), std::string::npos);
    write_parts(file, {beauty});
    EXPECT_EQ(color(), amber);
    EXPECT_EQ(color("beauty"), amber);
    const LayeredImage all = read_exr(file);
    ASSERT_EQ(all.layers.size(), 1u);
    EXPECT_EQ(all.layers[0].channel_names, "RGBA");

    // Views of one part are layers, of which one has no name (OpenEXR, "Storing Multi-View Images").
    ExrContent stereo(4, 2);
    stereo.add("", "RGB", {0.75, 0.5, 0.25}), stereo.add("right.", "RGB", {5, 5, 5});
    stereo.change = [](Imf::Header& header) { Imf::addMultiView(header, {"left", "right"}); };
    stereo.write(file);
    EXPECT_EQ(color(), amber);
    EXPECT_EQ(color("right"), glm::vec3(5));
    EXPECT_EQ(color("left"), amber);
    EXPECT_NE(refused("top").find("has no layer 'top'; it has R G B without a layer's name, 'right' (R G B)"),
              std::string::npos)
        << refused("top");

    Imf::Header deep(4, 2);
    deep.channels().insert("R", Imf::Channel(Imf::HALF)), deep.channels().insert("G", Imf::Channel(Imf::HALF));
    deep.channels().insert("B", Imf::Channel(Imf::HALF));
    deep.setType(Imf::DEEPSCANLINE), deep.setName("deep"), deep.compression() = Imf::NO_COMPRESSION;
    const std::vector<Imf::Header> headers = {beauty.header(), deep};
    {
        Imf::MultiPartOutputFile out(file.c_str(), headers.data(), 2);
        std::vector<std::vector<char>> storage;
        Imf::OutputPart part(out, 0);
        part.setFrameBuffer(beauty.frame(storage)), part.writePixels(2);
    }
    EXPECT_EQ(color(), amber);
    EXPECT_NE(refused("deep").find("part 'deep': its pixels are deep"), std::string::npos) << refused("deep");
}

TEST_F(ExrPictures, IntegersThatFloatsDoNotTellApartAreRefused) {
    ExrContent content(2, 1);
    content.add("id.Y", 16777216, Imf::UINT);
    content.write(file);
    EXPECT_EQ(color("id"), glm::vec3(16777216));
    content.add("id.Y", 2399141889.0, Imf::UINT);
    content.write(file);
    EXPECT_NE(refused("id").find("channel 'id.Y' has the integer 2399141889"), std::string::npos) << refused("id");
    EXPECT_NE(error_message([&] { read_exr(file); }).find("2399141889"), std::string::npos);
}
