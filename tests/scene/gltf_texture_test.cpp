// Which image a texture shows, and which files are not touched.
#include "core/files.h"
#include "core/png.h"
#include "tests/reading_limits.h"
#include "tests/scene/gltf_fixture.h"

#include <webp/encode.h>
#include <random>

namespace {

struct Textures : Gltf {
    std::string png;   ///< 2 x 1: orange
    std::string webp;  ///< 3 x 2: lossless, straight alpha

    void SetUp() override {
        Gltf::SetUp();
        HostImage image({2, 1}, 3);
        image.values = {1, 0.2f, 0, 1, 0.2f, 0};
        write_png(folder / "t.png", image);
        png = read_text(folder / "t.png");
        uint8_t* bytes = nullptr;
        const size_t size = WebPEncodeLosslessRGBA(webp_texels().data(), 3, 2, 12, &bytes);
        webp.assign(reinterpret_cast<const char*>(bytes), size);
        WebPFree(bytes);
        write_text(folder / "t.webp", webp);
        writer.json["images"] = {{{"uri", "t.png"}}};
        writer.json["textures"] = {{{"source", 0}}};
        writer.json["materials"] = {{{"name", "m"}, {"emissiveTexture", {{"index", 0}}}}};
        nlohmann::json quad = writer.quad();
        quad["material"] = 0;
        writer.add_mesh_node(quad);
    }
    static std::vector<uint8_t> webp_texels() {
        std::vector<uint8_t> rgba(24);
        for (size_t i = 0; i < rgba.size(); ++i) rgba[i] = uint8_t(i * 10);
        rgba[3] = 255;  // a texel of alpha 0 may lose its colour
        return rgba;
    }
    /// The texture that the emission shows.
    Texture shown() {
        const Scene scene = load();
        return scene.textures.at(size_t(scene.materials.at(0).emission_texture.texture));
    }
    bool shows_png() { return shown().extent == glm::uvec2(2, 1); }
    bool shows_webp() {
        const Texture texture = shown();
        return texture.extent == glm::uvec2(3, 2) && *texture.rgba == webp_texels();
    }
    std::string said() {
        return error_message([&] { load(); });
    }
    static nlohmann::json data_uri(const std::string& type, const std::string& bytes) {
        return {{"uri", "data:" + type + ";base64," + base64(bytes)}};
    }
};
}  // namespace

TEST_F(Textures, DataUrisOfAnyTypeAreReadByTheirContents) {
    for (const char* type : {"image/png", "image/PNG", "IMAGE/png;charset=utf-8", "image/jpeg", "", "text/plain;a=b"}) {
        writer.json["images"][0] = data_uri(type, png);
        EXPECT_TRUE(shows_png()) << type;
    }
    const std::string text = base64(std::string(1000, 'x'));
    for (const char* type : {"image/png", "image/ktx2", "image/webp;q=1"}) {
        writer.json["images"][0] = data_uri(type, std::string(1000, 'x'));
        EXPECT_NE(said().find(std::string("image 0 ('data:") + std::string(type).substr(0, 9)), std::string::npos)
            << said();
        EXPECT_NE(said().find("(1000 bytes)"), std::string::npos) << said();
        EXPECT_EQ(said().find(text.substr(0, 16)), std::string::npos) << said();
    }
    // Nor where the JSON itself is at fault.
    writer.json["images"] = {{{"name", 1}, {"uri", "data:image/png;base64," + text}}};
    EXPECT_EQ(said().find(text.substr(0, 16)), std::string::npos) << said();
    writer.json["images"] = writer.json["images"][0]["uri"];
    EXPECT_EQ(said().find(text.substr(0, 16)), std::string::npos) << said();
    const std::string cut = "{\"images\": [{\"uri\": \"data:image/png;base64," + text;
    write_text(folder / "cut.gltf", cut);
    const std::string message = error_message([&] { load_gltf(folder / "cut.gltf"); });
    EXPECT_NE(message.find("not valid JSON"), std::string::npos) << message;
    EXPECT_EQ(message.find(text.substr(0, 16)), std::string::npos) << message;
}

TEST_F(Textures, ImagesThatNothingDrawsAreNotTouched) {
    writer.json["images"] = {
        {{"uri", "t.png"}}, {{"uri", "missing.png"}}, {{"uri", "missing.ktx2"}}, {{"bufferView", 99}}};
    writer.json["textures"] = {{{"source", 0}}, {{"source", 1}}, {{"source", 2}}};
    EXPECT_TRUE(shows_png());
    // Of a material that no primitive has, of a mesh in no shown node, and of occlusion, which both renderers solve
    // for.
    writer.json["materials"].push_back({{"name", "unused"}, {"normalTexture", {{"index", 1}}}});
    writer.json["materials"].push_back({{"name", "elsewhere"}, {"normalTexture", {{"index", 2}}}});
    nlohmann::json quad = writer.quad();
    quad["material"] = 2;
    writer.json["meshes"].push_back({{"primitives", {quad}}});
    writer.json["materials"][0]["occlusionTexture"] = {{"index", 1}};
    const Scene scene = load();
    EXPECT_EQ(scene.textures.size(), 1u);
    EXPECT_EQ(scene.materials[0].occlusion_texture.texture, -1);
    EXPECT_FALSE(mentions(scene.warnings, "missing"));
    // The texture of another use is listed as that of occlusion, too.
    writer.json["materials"][0]["occlusionTexture"] = {{"index", 0}};
    writer.json["materials"][0]["pbrMetallicRoughness"]["metallicRoughnessTexture"] = {{"index", 0}};
    const Material m = load().materials[0];
    EXPECT_GE(m.occlusion_texture.texture, 0);
    EXPECT_EQ(m.occlusion_texture.texture, m.metalness_roughness_texture.texture);
    // What is drawn must be there.
    writer.json["materials"][0]["normalTexture"] = {{"index", 1}};
    EXPECT_NE(said().find("image 1 ('missing.png'): cannot read"), std::string::npos) << said();
}

TEST_F(Textures, WebpIsReadAndItsFallbackTaken) {
    writer.json["images"].push_back({{"uri", "t.webp"}});
    nlohmann::json& texture = writer.json["textures"][0];
    texture["extensions"]["EXT_texture_webp"]["source"] = 1;
    writer.json["extensionsUsed"] = {"EXT_texture_webp"};
    EXPECT_TRUE(shows_png());
    EXPECT_TRUE(load().warnings.empty());
    writer.json["images"][0]["uri"] = "missing.png";
    EXPECT_TRUE(shows_webp());
    EXPECT_TRUE(mentions(load().warnings, "image 1 ('t.webp') is shown in place of another: "));
    writer.json["images"][0]["uri"] = "t.png";
    writer.json["extensionsRequired"] = {"EXT_texture_webp"};
    EXPECT_TRUE(shows_webp());
    texture.erase("source");
    EXPECT_TRUE(shows_webp());
    writer.json["images"][1] = data_uri("image/webp", webp);
    EXPECT_TRUE(shows_webp());
    writer.json["images"][1] = {{"bufferView", writer.view(webp.data(), webp.size())}, {"mimeType", "image/webp"}};
    EXPECT_TRUE(shows_webp());

    for (const std::string& broken : {webp.substr(0, webp.size() - 6), std::string("RIFF")}) {
        writer.json["images"][1] = data_uri("image/webp", broken);
        EXPECT_NE(said().find("image 1 ('data:image/webp ("), std::string::npos) << said();
        texture["source"] = 0;
        EXPECT_TRUE(shows_png());
        EXPECT_TRUE(mentions(load().warnings, "image 0 ('t.png') is shown in place of another: ")) << broken;
        texture.erase("source");
    }
    uint8_t* bytes = nullptr;
    const std::vector<uint8_t> grey(600 * 600 * 4, 128);
    const size_t size = WebPEncodeLosslessRGBA(grey.data(), 600, 600, 2400, &bytes);
    writer.json["images"][1] = data_uri("image/webp", {reinterpret_cast<const char*>(bytes), size});
    WebPFree(bytes);
    const LimitsOf limits({.memory = 1'000'000});
    EXPECT_NE(said().find("--max-memory"), std::string::npos) << said();
}

TEST_F(Textures, DamagedWebpNeverCrashes) {
    writer.json["images"][0] = {{"uri", "d.webp"}};
    const fs::path file = writer.write_glb(folder / "a.glb");
    std::mt19937 random(3);
    unsigned refused = 0;
    uint8_t* bytes = nullptr;
    const size_t size = WebPEncodeRGBA(webp_texels().data(), 3, 2, 12, 50, &bytes);
    const std::string lossy(reinterpret_cast<const char*>(bytes), size);
    WebPFree(bytes);
    for (int i = 0; i < 300; ++i) {
        std::string damaged = i % 2 ? webp : lossy;
        for (unsigned flips = 1 + random() % 3; flips > 0; --flips) damaged[random() % damaged.size()] = char(random());
        write_text(folder / "d.webp", damaged);
        refused += error_message([&] { load_gltf(file); }) != "no error";
    }
    EXPECT_GT(refused, 50u);
}

TEST_F(Textures, OfOtherKindsShowTheirFallback) {
    const std::string ktx2("\xABKTX 20\xBB\r\n\x1A\n", 12);
    writer.json["images"].push_back(data_uri("image/ktx2", ktx2 + std::string(4000, '\0')));
    nlohmann::json& texture = writer.json["textures"][0];
    for (const char* extension : {"KHR_texture_basisu", "MSFT_texture_dds", "EXT_texture_avif"}) {
        texture = {{"source", 0}, {"extensions", {{extension, {{"source", 1}}}}}};
        EXPECT_TRUE(shows_png());
        EXPECT_TRUE(mentions(load().warnings, "shows the PNG or JPEG that its file has as a fallback"));
        texture.erase("source");
        const Scene scene = load();
        EXPECT_EQ(scene.materials[0].emission_texture.texture, -1);
        EXPECT_TRUE(mentions(scene.warnings, std::string("(") + extension + ") cannot be decoded; `"));
        EXPECT_TRUE(mentions(scene.warnings, "The emissive texture of material 'm' is ignored"));
    }
}

TEST_F(Textures, SetsOfCoordinatesAreThoseThatTheMaterialUses) {
    nlohmann::json& attributes = writer.json["meshes"][0]["primitives"][0]["attributes"];
    nlohmann::json& material = writer.json["materials"][0];
    for (const int set : {1, 2, 3, 7})
        attributes["TEXCOORD_" + std::to_string(set)] = writer.floats(std::vector<float>(8, float(set)), "VEC2");
    const auto set_of = [](const Scene& scene, const TextureSlot& slot) {
        return scene.meshes.at(0).vertices.at(3).uv[slot.texcoord].x;  // the first corner's is 0 in set 0, too
    };
    material["emissiveTexture"]["texCoord"] = 2;
    Scene scene = load();
    EXPECT_EQ(set_of(scene, scene.materials[0].emission_texture), 2.0f);
    EXPECT_TRUE(scene.warnings.empty()) << scene.warnings.front().text;
    material["normalTexture"] = {{"index", 0}, {"extensions", {{"KHR_texture_transform", {{"texCoord", 7}}}}}};
    scene = load();
    EXPECT_EQ(set_of(scene, scene.materials[0].emission_texture), 2.0f);
    EXPECT_EQ(set_of(scene, scene.materials[0].normal_texture), 7.0f);
    EXPECT_TRUE(scene.warnings.empty());
    material["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", 0}, {"texCoord", 1}};
    scene = load();
    EXPECT_EQ(set_of(scene, scene.materials[0].base_color_texture), 1.0f);
    EXPECT_EQ(set_of(scene, scene.materials[0].normal_texture), 7.0f);
    EXPECT_TRUE(mentions(scene.warnings,
                         "The emissive texture of material 'm' uses TEXCOORD_2, a third set of texture "
                         "coordinates beside TEXCOORD_1 and TEXCOORD_7"));
    material = {{"name", "m"}, {"emissiveTexture", {{"index", 0}, {"texCoord", 4}}}};
    EXPECT_TRUE(mentions(load().warnings, "Mesh 0 has no TEXCOORD_4, which the emissive texture of material 'm' uses"));
    attributes.erase("TEXCOORD_0");
    material["emissiveTexture"] = {{"index", 0}};
    EXPECT_TRUE(mentions(load().warnings, "Mesh 0 has no TEXCOORD_0"));
}
