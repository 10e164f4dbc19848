// What of other programs' files is read as which layer of a capture, and what is said of it. A room's corner stands for
// an engine's frame.
#include "core/error.h"
#include "core/exr/exr_pixels.h"
#include "core/gbuffer/camera_file.h"
#include "core/gbuffer/gbuffer_file.h"
#include "core/gbuffer/pixel_position.h"
#include "tests/error_message.h"
#include "tests/exr_writer.h"

#include <ImfChromaticitiesAttribute.h>
#include <ImfStandardAttributes.h>
#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>

namespace fs = std::filesystem;

namespace {

constexpr glm::uvec2 extent(96, 72);  // neighbouring rows of a floor must be within 5 % of distance

/// Planes that a camera at (0, 0, 3), which looks along -z, may see.
struct Plane {
    glm::dvec3 normal;  ///< unit
    double distance;    ///< m, along it
};
const Plane floor_below{{0, 1, 0}, -1}, back_wall{{0, 0, 1}, -2}, ceiling_above{{0, -1, 0}, -1};

class GBufferLayers : public testing::Test {
protected:
    fs::path folder = fs::temp_directory_path() / "layers";
    CameraData camera;

    GBufferLayers() : camera(camera_of({.near = 0.1f, .far = 50})) {}
    static CameraData camera_of(CameraPose pose) {
        pose.vertical_fov = 1, pose.world_from_view[3] = {0, 0, 3, 1};
        return camera_data(pose, nullptr, {.extent = extent});
    }
    void SetUp() override {
        fs::remove_all(folder);
        fs::create_directories(folder);
    }
    void TearDown() override { fs::remove_all(folder); }

    /// Depth and normals of the nearest plane that each pixel shows; background where there is none within the planes.
    ExrContent content(const std::vector<Plane>& planes, bool is_upside_down = false) const {
        HostGBuffer g{.camera = camera, .depth = HostImage(extent, 1, 1.0f), .normal = HostImage(extent, 3)};
        const glm::dvec3 eye(camera.world_from_view[3]);
        for (size_t i = 0; i < g.depth.pixel_count(); ++i) {
            const glm::dvec3 direction = view_direction(g, i);
            double nearest = 20;
            for (const Plane& plane : planes) {
                const double t = (plane.distance - glm::dot(plane.normal, eye)) / glm::dot(plane.normal, direction);
                if (!(t > 0 && t < nearest)) continue;
                nearest = t;
                const glm::dvec4 clip = glm::dmat4(camera.clip_from_world) * glm::dvec4(eye + t * direction, 1);
                g.depth.values[i] = float(clip.z / clip.w), g.normal.set_rgb(i, plane.normal);
            }
        }
        ExrContent file(int(extent.x), int(extent.y));
        const auto at = [is_upside_down](int x, int y) {
            return size_t(is_upside_down ? int(extent.y) - 1 - y : y) * extent.x + size_t(x);
        };
        file.add("depth.Z", [depth = g.depth, at](int x, int y) { return depth.values[at(x, y)]; });
        for (int c = 0; c < 3; ++c)
            file.add(
                std::string("normal.") + "XYZ"[c],
                [normal = g.normal, at, c](int x, int y) { return normal.rgb(at(x, y))[c]; }, Imf::HALF);
        file.add("roughness.Y", 0.25), file.add("metalness.Y", 0.5);
        file.add("base_color.", "RGB", {0.75, 0.5, 0.25}), file.add("lit.", "RGB", {3, 2, 1});
        return file;
    }

    LoadedGBuffer load() const {
        write_camera(folder / "camera.json", {camera});
        return load_gbuffer(folder);
    }
    std::string notes(const ExrContent& content) const {
        content.write(folder / "gbuffer.exr");
        std::string all;
        for (const std::string& note : load().notes) all += note + "\n";
        return all;
    }
    std::string refusal(const ExrContent& content) const {
        content.write(folder / "gbuffer.exr");
        return error_message([&] { load(); });
    }
};

#define EXPECT_SAYS(text, part) EXPECT_NE((text).find(part), std::string::npos) << (text)

void rename(ExrContent& content, const std::string& from, const std::string& to) {
    content.channels[to] = content.channels.at(from);
    content.channels.erase(from);
}

void expect_same(const HostGBuffer& a, const HostGBuffer& b) {
    for (const auto image : {&HostGBuffer::depth, &HostGBuffer::normal, &HostGBuffer::base_color, &HostGBuffer::lit,
                             &HostGBuffer::material_id})
        EXPECT_EQ((a.*image).values, (b.*image).values);
}

}  // namespace

TEST_F(GBufferLayers, ChannelsAreChosenByName) {
    const ExrContent plain = content({floor_below, back_wall});
    EXPECT_EQ(notes(plain), "");
    const HostGBuffer expected = load().gbuffer;
    EXPECT_EQ(expected.base_color.rgb(7), glm::vec3(0.75f, 0.5f, 0.25f));

    ExrContent other = plain;
    for (int c = 0; c < 3; ++c) {
        const std::string rgb(1, "RGB"[c]), small(1, "rgb"[c]), xyz(1, "XYZ"[c]);
        rename(other, "base_color." + rgb, "base_color." + small), rename(other, "lit." + rgb, "lit." + small);
        rename(other, "normal." + xyz, "normal." + rgb);  // as programs for pictures name three channels
    }
    rename(other, "roughness.Y", "roughness"), rename(other, "metalness.Y", "metalness.V"),
        rename(other, "depth.Z", "depth.R");
    EXPECT_EQ(notes(other), "");
    expect_same(load().gbuffer, expected);

    other.add("base_color.a", 1), other.add("depth.AO", 1), other.add("AO", 1, Imf::HALF),
        other.add("", "RGB", {9, 9, 9});
    other.add("beauty.red", 1), other.add("objectID", 4'000'000'000.0, Imf::UINT), other.add("motoin.X", 1);
    const std::string said = notes(other);
    expect_same(load().gbuffer, expected);
    EXPECT_SAYS(said, "Layers or channels that are not used: 'AO'");
    EXPECT_SAYS(said, "R G B without a layer's name");
    EXPECT_SAYS(said, "'base_color' (a)");
    EXPECT_SAYS(said, "'objectID'");
    EXPECT_SAYS(said, "The layer 'motoin' is not used; did you mean 'motion'?");

    rename(other, "normal.B", "normal.W");
    EXPECT_SAYS(refusal(other), "gbuffer.exr: layer 'normal' (R G W) needs the channels X Y Z");
    other.channels.erase("normal.R"), other.channels.erase("normal.G"), other.channels.erase("normal.W");
    EXPECT_SAYS(refusal(other), "lacks the layer 'normal'; it has ");
}

TEST_F(GBufferLayers, PartsAreLayers) {
    const ExrContent plain = content({floor_below, back_wall});
    plain.write(folder / "gbuffer.exr");
    const HostGBuffer expected = load().gbuffer;
    std::vector<ExrContent> parts;
    for (const std::string layer : {"lit", "normal", "depth", "roughness", "base_color", "metalness"}) {
        ExrContent& part = parts.emplace_back(int(extent.x), int(extent.y));
        part.part = layer;
        for (const auto& [name, channel] : plain.channels)  // some name the layer again
            if (name.starts_with(layer + "."))
                part.channels[layer == "normal" ? name : name.substr(layer.size() + 1)] = channel;
    }
    write_parts(folder / "gbuffer.exr", parts);
    EXPECT_TRUE(load().notes.empty());
    expect_same(load().gbuffer, expected);
}

TEST_F(GBufferLayers, WhatTheDataWindowLeavesOutIsBackground) {
    ExrContent cropped = content({back_wall});
    cropped.data = {{8, 6}, {39, 25}};
    EXPECT_SAYS(notes(cropped),
                "6272 pixels of the display window (0..95 x 0..71) lie outside of the data window "
                "(8..39 x 6..25): they count as background without light.");
    const HostGBuffer g = load().gbuffer;
    for (unsigned y = 0; y < extent.y; ++y)
        for (unsigned x = 0; x < extent.x; ++x) {
            const bool is_stored = x >= 8 && x <= 39 && y >= 6 && y <= 25;
            const size_t i = size_t(y) * extent.x + x;
            ASSERT_EQ(is_background(g, i), !is_stored);
            ASSERT_EQ(g.lit.rgb(i), is_stored ? glm::vec3(3, 2, 1) : glm::vec3(0));
            ASSERT_EQ(g.material_id.values[i], is_stored ? 1 : 0);
        }
    ExrContent shifted = content({back_wall});  // a crop that was moved to the origin keeps its place in the plane
    shifted.display = {{100, 200}, {195, 271}}, shifted.data = shifted.display;
    for (auto& [name, channel] : shifted.channels)
        channel.value = [value = channel.value](int x, int y) { return value(x - 100, y - 200); };
    EXPECT_EQ(notes(shifted), "");
    ExrContent region = content({back_wall});
    region.display = {{0, 0}, {1919, 1079}};
    EXPECT_SAYS(refusal(region),
                "is 1920 x 1080, but camera.json says 96 x 72; that is its display window (0..1919 x "
                "0..1079), its data window is 0..95 x 0..71: if that is the picture");
}

TEST_F(GBufferLayers, ColoursAreConvertedAndVectorsAreNot) {
    ExrContent wide = content({back_wall});
    for (int c = 0; c < 3; ++c) rename(wide, std::string("normal.") + "XYZ"[c], std::string("normal.") + "RGB"[c]);
    wide.change = [](Imf::Header& header) {
        Imf::addChromaticities(header, {{0.708f, 0.292f}, {0.170f, 0.797f}, {0.131f, 0.046f}, {0.3127f, 0.3290f}});
    };
    const std::string said = notes(wide);
    EXPECT_SAYS(said, "converted from Rec. 2020 to Rec. 709");
    EXPECT_EQ(std::ranges::count(said, '\n'), 1) << said;  // once
    const HostGBuffer g = load().gbuffer;
    EXPECT_EQ(g.normal.rgb(5), glm::vec3(0, 0, 1));
    // The inverse of ITU-R BT.2087-0's matrix, red: 1.660491 -0.587641 -0.072850.
    EXPECT_NEAR(g.lit.rgb(5).x, 3 * 1.660491f - 2 * 0.587641f - 0.072850f, 1e-4f);
}

TEST_F(GBufferLayers, WhatLosesDigitsIsNamed) {
    ExrContent file = content({back_wall});
    file.compression = Imf::DWAA_COMPRESSION;
    EXPECT_SAYS(notes(file),
                "The file is compressed by DWAA, which takes the channels R, G, B and Y for colours, changes them, and "
                "cuts them off at 65504. That concerns the layers 'normal' (Y), 'roughness' (Y), 'base_color' (R G B), "
                "'metalness' (Y), 'lit' (R G B). Write the file with ZIP, PIZ or without compression.");
    file.compression = Imf::PXR24_COMPRESSION;
    EXPECT_SAYS(notes(file),
                "by PXR24, which rounds 32-bit floats to 24 bits. That concerns the layers 'depth' (Z), 'r");
    file.compression = Imf::B44A_COMPRESSION;
    EXPECT_SAYS(notes(file),
                "by B44A, which stores 16 half floats in 14 bytes. That concerns the layers 'normal' (X Y Z).");
    file.compression = Imf::ZIPS_COMPRESSION;
    EXPECT_EQ(notes(file), "");
    file.channels["depth.Z"].type = Imf::HALF;
    EXPECT_SAYS(notes(file), "The layer 'depth' is stored as half floats");
}

/// That the named channels change, and no others, as OpenEXR itself writes and reads them.
TEST_F(GBufferLayers, CompressionsChangeTheChannelsThatAreNamed) {
    const auto wave = [](double step) { return [step](int x, int y) { return 0.5 + 0.3 * std::sin(step * x + y); }; };
    ExrContent exact(int(extent.x), int(extent.y));
    for (const char* name : {"n.X", "n.Y", "n.Z", "c.R", "c.G", "c.B", "c.A", "z.Z", "one"})
        for (const auto& [kind, type] : {std::pair("half.", Imf::HALF), std::pair("float.", Imf::FLOAT)})
            exact.add(std::string(kind) + name, wave(0.7), type);
    exact.add(
        "id.Y", [](int x, int y) { return 1 + (x * y) % 9; }, Imf::UINT);
    exact.add("sun.R", [](int x, int y) { return x == 5 && y == 5 ? 1e6 : 0.6; });
    exact.write(folder / "exact.exr");
    const ExrHeader header = read_exr_header(folder / "exact.exr");
    const auto planes_of = [&](const fs::path& file) {
        std::vector<ExrPlanes> planes;
        for (size_t c = 0; c < header.parts[0].channels.size(); ++c) planes.push_back({.part = 0, .channels = {c}});
        read_planes(file, read_exr_header(file), planes);
        return planes;
    };
    const std::vector<ExrPlanes> expected = planes_of(folder / "exact.exr");
    for (const auto compression :
         {Imf::ZIP_COMPRESSION, Imf::PIZ_COMPRESSION, Imf::PXR24_COMPRESSION, Imf::B44_COMPRESSION,
          Imf::B44A_COMPRESSION, Imf::DWAA_COMPRESSION, Imf::DWAB_COMPRESSION}) {
        exact.compression = compression;
        exact.write(folder / "lossy.exr");
        const ExrPart part = read_exr_header(folder / "lossy.exr").parts[0];
        const std::vector<ExrPlanes> found = planes_of(folder / "lossy.exr");
        for (size_t c = 0; c < found.size(); ++c) {
            EXPECT_EQ(found[c].image.values != expected[c].image.values, part.is_lossy(part.channels[c]))
                << part.compression_name() << " " << part.channels[c].name;
            EXPECT_TRUE(!part.is_lossy(part.channels[c]) || *part.loss());
            EXPECT_EQ(std::ranges::max(found[c].image.values) > 65504,
                      part.channels[c].name == "sun.R" && !std::string_view(part.loss()).ends_with("65504"));
        }
    }
}

TEST_F(GBufferLayers, DepthsOfFewBitsAreSaid) {
    const auto said = [&](double largest, DepthFormat format = DepthFormat::d32f) {
        ExrContent file = content({floor_below, back_wall});
        file.channels["depth.Z"].value = [value = file.channels["depth.Z"].value, largest](int x, int y) {
            return std::round(value(x, y) * largest) / largest;
        };
        file.write(folder / "gbuffer.exr");
        write_camera(folder / "camera.json", {camera, format});
        std::string text;
        for (const std::string& note : load_gbuffer(folder).notes) text += note + "\n";
        return text;
    };
    camera = camera_of({.near = 0.5f, .far = 6});  // at least 8 codes of 8 bits
    EXPECT_SAYS(said(255), "All depths are multiples of 1/255, as of an image of 8 bits");
    EXPECT_SAYS(said(65535), "All depths are multiples of 1/65535, but 'depth_format' of camera.json has finer steps");
    EXPECT_EQ(said(65535, DepthFormat::d16), "");
    EXPECT_EQ(said(16777215), "");
}

TEST_F(GBufferLayers, NumbersOfMaterialsAreWholeAndKeptApart) {
    ExrContent file = content({back_wall});
    file.add(
        "material_id.Y", [](int x, int) { return x < 24 ? 16777215 : 16777216; }, Imf::UINT);
    EXPECT_EQ(notes(file), "");
    EXPECT_EQ(load().gbuffer.material_id.values[23], 16777215);
    EXPECT_EQ(load().gbuffer.material_id.values[24], 16777216);
    file.add(
        "material_id.Y", [](int x, int) { return x < 16 ? 0x8F000001u : 0x8F000002u; }, Imf::UINT);
    EXPECT_SAYS(refusal(file),
                "layer 'material_id' has the number 2399141889 in pixel (0, 0), but numbers above 16777216");
    file.add("material_id.Y", 2399141889.0);
    EXPECT_SAYS(refusal(file), "layer 'material_id' has the number 2399141");
    file.add(
        "material_id.Y", [](int x, int) { return x; }, Imf::HALF);
    EXPECT_EQ(notes(file), "");
    file.add(
        "material_id.Y", [](int x, int) { return 1990 + x; }, Imf::HALF);
    EXPECT_SAYS(notes(file), "'material_id' is stored as half floats, which keep numbers above 2048 apart no longer");
}

TEST_F(GBufferLayers, WhyNumbersOfMaterialsAreNotWholeIsSaid) {
    ExrContent file = content({back_wall});
    const auto said = [&](const std::function<double(int x, int y)>& value, Imf::PixelType type = Imf::FLOAT) {
        file.add("material_id.Y", value, type);
        return notes(file);
    };
    const auto share_of = [](double whole) { return [whole](int x, int) { return (x - x % 7) / whole; }; };
    EXPECT_SAYS(said([](int x, int) { return x < 48 ? 0 : 7 / 4294967295.0; }),
                "3456 pixels have a material_id that is no whole number: they are shares of 4294967295, as oiiotool");
    EXPECT_SAYS(said(share_of(4294967295.0)), "shares of 4294967295");
    EXPECT_SAYS(said(share_of(65535)),
                "shares of 65535, as of a texture whose format is 'unorm'. Multiply them by 65535.");
    EXPECT_SAYS(said(share_of(255)), "shares of 255");
    EXPECT_SAYS(said(share_of(255), Imf::HALF), "shares of 255");
    EXPECT_SAYS(said([](int x, int) { return x < 48 ? -1 : 1; }),
                "3456 pixels have a material_id that is no whole "
                "number: some are negative or not finite");
    EXPECT_SAYS(said([](int x, int) { return 1 + x / 10.0; }), "a filter mixed the numbers of neighbours");
    file.compression = Imf::DWAA_COMPRESSION;
    EXPECT_SAYS(said([](int x, int y) { return 1 + (x / 8 + y / 8) % 9; }), "the compression DWAA changed them");
}

/// glTF 2.0, 5.13: an orthographic camera's near plane may lie at 0.
TEST_F(GBufferLayers, OrthographicCamerasWithANearPlaneOfZeroComeBack) {
    for (const auto direction : {DepthDirection::standard, DepthDirection::reversed}) {
        CameraPose pose{.is_orthographic = true, .orthographic_height = 4, .near = 0, .far = 20};
        camera = camera_data(pose, nullptr, {.extent = extent, .depth_direction = direction});
        HostGBuffer g{.camera = camera,
                      .depth = HostImage(extent, 1, 0.25f),
                      .normal = HostImage(extent, 4),
                      .base_color = HostImage(extent, 4, 0.5f)};
        for (size_t i = 0; i < g.normal.pixel_count(); ++i) g.normal.set_rgb(i, {0, 0, 1});
        save_gbuffer(folder, g);
        const LoadedGBuffer loaded = load_gbuffer(folder);
        EXPECT_EQ(loaded.notes, std::vector<std::string>{});
        EXPECT_EQ(std::memcmp(&loaded.gbuffer.camera, &g.camera, sizeof g.camera), 0);
        EXPECT_EQ(loaded.gbuffer.depth.values, g.depth.values);
        const float distance = direction == DepthDirection::standard ? 5.0f : 15.0f;  // near + d (far - near)
        EXPECT_NEAR(view_distance(loaded.gbuffer.camera, 0.25f), distance, 1e-5f);
    }
    CameraPose perspective{.near = 0.1f, .far = 20};
    camera = camera_data(perspective, nullptr, {.extent = extent});
    camera.depth.x = 0;
    EXPECT_SAYS(refusal(content({back_wall})), "'near' = 0");
}

TEST_F(GBufferLayers, UpsideDownRowsAreRecognised) {
    const std::vector<std::vector<Plane>> rooms = {
        {floor_below}, {floor_below, back_wall}, {floor_below, back_wall, ceiling_above}};
    for (const auto& room : rooms) {
        EXPECT_EQ(notes(content(room)), "");
        EXPECT_SAYS(notes(content(room, true)), "The rows are upside down");
    }
    EXPECT_EQ(notes(content({ceiling_above})), "");
    const auto inward = [&](std::vector<Plane> planes) {
        ExrContent file = content(planes);
        for (const char* name : {"normal.X", "normal.Y", "normal.Z"})
            file.channels[name].value = [value = file.channels[name].value](int x, int y) { return -value(x, y); };
        return file;
    };
    EXPECT_SAYS(notes(inward({floor_below})), "they would, taken pointing into the surface");
    EXPECT_SAYS(notes(inward({floor_below, back_wall})), "they would, taken pointing into the surface");
    EXPECT_EQ(notes(content({back_wall}, true)), "");  // a wall says nothing of above and below
}
