#include "core/files.h"
#include "core/png.h"
#include "core/scene/material_override.h"
#include "tests/png_writer.h"
#include "tests/scene/gltf_fixture.h"

#include <cstring>

namespace {
struct Images : Gltf {
    std::string png;  ///< 3 x 1: black, grey 0.5 (code 188), white

    void SetUp() override {
        Gltf::SetUp();
        HostImage image({3, 1}, 3);
        image.values = {0, 0, 0, 0.5f, 0.5f, 0.5f, 1, 1, 1};
        write_png(folder / "t.png", image);
        png = read_text(folder / "t.png");
        writer.json["materials"] = {{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
        writer.json["textures"] = {{{"source", 0}, {"sampler", 0}}};
        writer.json["samplers"] = {{{"wrapS", 33071}, {"wrapT", 33648}, {"magFilter", 9728}}};
        nlohmann::json quad = writer.quad();
        quad["material"] = 0;
        writer.add_mesh_node(quad);
    }
    void expect_texels(const Scene& scene) {
        const Texture& texture = scene.textures.at(0);
        EXPECT_EQ(texture.extent, glm::uvec2(3, 1));
        EXPECT_EQ(*texture.rgba, (std::vector<uint8_t>{0, 0, 0, 255, 188, 188, 188, 255, 255, 255, 255, 255}));
    }
};
}  // namespace

TEST_F(Images, AreReadFromFilesBuffersAndDataUris) {
    writer.json["images"] = {{{"uri", "t.png"}}};
    const Scene external = load();
    expect_texels(external);
    EXPECT_EQ(external.textures[0].wrap_u, TextureWrap::clamp_to_edge);
    EXPECT_EQ(external.textures[0].wrap_v, TextureWrap::mirrored_repeat);
    EXPECT_TRUE(external.textures[0].is_nearest);
    writer.json["images"] = {{{"uri", "data:image/png;base64," + base64(png)}}};
    expect_texels(load());
    writer.json["images"] = {{{"bufferView", writer.view(png.data(), png.size())}, {"mimeType", "image/png"}}};
    expect_texels(load());
}

TEST_F(Images, MayBeNamedWithBlanks) {
    fs::rename(folder / "t.png", folder / "a tile.png");
    writer.json["images"] = {{{"uri", "a%20tile.png"}}};
    expect_texels(load());
}

TEST_F(Images, BuffersMayBeDataUris) {
    writer.json["images"] = {{{"uri", "t.png"}}};
    const std::string bytes(reinterpret_cast<const char*>(writer.bytes.data()), writer.bytes.size());
    writer.json["buffers"] = {
        {{"byteLength", bytes.size()}, {"uri", "data:application/octet-stream;base64," + base64(bytes)}}};
    write_text(folder / "d.gltf", writer.json.dump());
    EXPECT_EQ(load_gltf(folder / "d.gltf").triangle_count(), 2u);
}

TEST_F(Images, MissingOrBrokenOnesAreErrors) {
    writer.json["images"] = {{{"uri", "none.png"}}};
    EXPECT_NE(error_message([&] { load(); }).find("none.png"), std::string::npos);
    write_text(folder / "cut.png", png.substr(0, png.size() / 2));
    writer.json["images"] = {{{"uri", "cut.png"}}};
    EXPECT_NE(error_message([&] { load(); }).find("image 0 ('cut.png') cannot be decoded"), std::string::npos);
    std::string empty = png;
    empty[19] = 0;  // the lowest byte of the width in the header: 0 x 1 texels
    write_text(folder / "empty.png", empty);
    writer.json["images"] = {{{"uri", "empty.png"}}};
    EXPECT_NE(error_message([&] { load(); }).find("empty.png"), std::string::npos);
}

TEST_F(Images, OfUnknownKindsAreReported) {
    writer.json["images"] = {{{"uri", "t.png"}}};
    writer.json["textures"][0] = {{"extensions", {{"KHR_texture_basisu", {{"source", 0}}}}}};
    writer.json["extensionsUsed"] = {"KHR_texture_basisu"};
    const Scene scene = load();
    EXPECT_EQ(scene.materials[0].base_color_texture.texture, -1);
    EXPECT_TRUE(mentions(scene.warnings, "KTX2 (KHR_texture_basisu) cannot be decoded"));
    EXPECT_TRUE(mentions(scene.warnings, "base colour texture of material 'material_0' is ignored"));
}

TEST_F(Images, TransformsMayNameOtherCoordinates) {
    writer.json["images"] = {{{"uri", "t.png"}}};
    const float quarter = 1.57079633f;
    writer.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["extensions"]["KHR_texture_transform"] = {
        {"rotation", quarter}, {"scale", {2, 1}}, {"texCoord", 1}};
    const TextureSlot slot = load().materials[0].base_color_texture;
    EXPECT_EQ(slot.texcoord, 1u);
    // The extension's rotation matrix takes (u, v) = (2, 0) to (2 cos, -2 sin).
    expect_near(slot.uv_transform * glm::vec3(1, 0, 1), {0, -2, 1}, 1e-6f);
}

TEST_F(Images, TransmissionIsReported) {
    writer.json["images"] = {{{"uri", "t.png"}}};
    writer.json["materials"].push_back(
        {{"name", "pane"}, {"extensions", {{"KHR_materials_transmission", {{"transmissionFactor", 1}}}}}});
    writer.json["extensionsUsed"] = {"KHR_materials_transmission"};
    writer.json["extensionsRequired"] = {"KHR_materials_transmission"};
    writer.json["meshes"][0]["primitives"][0]["material"] = 1;
    const Scene scene = load();
    EXPECT_TRUE(mentions(scene.warnings, "'pane' transmits light"));
}

/// glTF 2.0, section 3.8.3: 16 bits are kept, v / 65535; what a file says of its colour space does not count; and its
/// bytes say what it is, whatever its name ends with.
TEST_F(Images, OfSixteenBitsKeepThem) {
    PngWriter wide{.width = 2, .depth = 16, .chunks = {{"gAMA", PngWriter::integer(100000)}}};
    wide.sample = [](unsigned x, unsigned, unsigned c) { return c == 1 ? 6808u + x : 65535u; };
    write_text(folder / "wide.jpg", wide.file());
    writer.json["images"] = {{{"uri", "wide.jpg"}}};
    const Scene scene = load();
    EXPECT_TRUE(scene.warnings.empty());
    const Texture& texture = scene.textures.at(0);
    ASSERT_EQ(texture.channel_bytes, 2u);
    ASSERT_EQ(texture.rgba->size(), 16u);
    uint16_t codes[8];
    std::memcpy(codes, texture.rgba->data(), sizeof codes);
    EXPECT_EQ((std::vector<unsigned>(codes, codes + 8)),
              (std::vector<unsigned>{65535, 6808, 65535, 65535, 65535, 6809, 65535, 65535}));
    Scene changed = scene;
    ChangedTexels none;
    const nlohmann::json entry = {{"material", ".*"}, {"base_color", {0.1, 0.2, 0.3}}};
    changed.materials[0].alpha_mode = AlphaMode::mask;
    JsonObject object(entry, "a.json");
    apply_override(object, changed, none);
    std::memcpy(codes, changed.textures.back().rgba->data(), sizeof codes);
    EXPECT_EQ((std::vector<unsigned>(codes, codes + 8)), std::vector<unsigned>(8, 65535));
}

/// The message says what the file is, how it is converted, and what a decoder says of a broken one.
TEST_F(Images, ThatCannotBeDecodedAreNamed) {
    const auto message = [&](const std::string& name, const std::string& bytes) {
        write_text(folder / name, bytes);
        writer.json["images"] = {{{"uri", name}}};
        return error_message([&] { load(); });
    };
    EXPECT_NE(message("a.png", "version https://git-lfs.github.com/spec/v1\n")
                  .find("image 0 ('a.png') cannot be decoded: it is a pointer of Git LFS"),
              std::string::npos);
    EXPECT_NE(message("b.png", "\xABKTX 20\xBB\r\n\x1A\n")
                  .find("it is a KTX 2 texture; convert it: ktx extract --transcode rgba8 b.png b.png"),
              std::string::npos);
    std::string damaged = png;
    damaged[damaged.find("IDAT") + 9] ^= 1;
    EXPECT_NE(
        message("c.png", damaged).find("image 0 ('c.png') cannot be decoded: as a PNG it is broken: IDAT: CRC error"),
        std::string::npos);
}

TEST_F(Images, WithHarmlessFaultsAreWarnedAbout) {
    std::string jpeg = read_text(fs::path(SSRLAB_SOURCE_DIR) / "tests/data/fuzz/texture/baseline.jpg");
    jpeg.insert(jpeg.size() - 2, 64, '\0');
    write_text(folder / "phone.jpg", jpeg);
    writer.json["images"] = {{{"uri", "phone.jpg"}}};
    const Scene scene = load();
    EXPECT_EQ(scene.textures.at(0).extent, glm::uvec2(18));
    EXPECT_TRUE(mentions(scene.warnings, "('phone.jpg')") && mentions(scene.warnings, "extraneous bytes"));
}
