// What small files may not do: take memory, read other folders, wait for ever.
#include "core/files.h"
#include "core/png.h"
#include "core/scene/material_override.h"
#include "core/scene/ranges.h"
#include "tests/png_writer.h"
#include "tests/reading_limits.h"
#include "tests/scene/gltf_fixture.h"

#include <sys/stat.h>
#include <ctime>
#include <set>

namespace {

struct GltfLimits : Gltf {
    std::string refused(const LimitsOf&) {
        const std::string message = error_message([&] { load(); });
        EXPECT_NE(message.find("--max-memory"), std::string::npos) << message;
        return message;
    }
    /// Materials that show `count` textures of the file's one image.
    void add_textures(size_t count, glm::uvec2 extent) {
        write_png(folder / "t.png", HostImage(extent, 3, 0.5f));
        writer.json["images"] = {{{"uri", "t.png"}}};
        for (size_t i = 0; i < count; ++i) {
            writer.json["textures"].push_back({{"source", 0}});
            writer.json["materials"].push_back(
                {{"name", "m" + std::to_string(i)},
                 {"pbrMetallicRoughness", {{"metallicRoughnessTexture", {{"index", i}}}}}});
        }
        nlohmann::json quad = writer.quad();
        nlohmann::json quads = nlohmann::json::array();  // since images that nothing draws are not loaded
        for (size_t i = 0; i < count; ++i) quad["material"] = i, quads.push_back(quad);
        writer.json["meshes"].push_back({{"primitives", quads}});
        writer.json["nodes"].push_back({{"mesh", 0}});
    }
    static size_t count_texels(const Scene& scene) {
        std::set<Texels> different;
        for (const Texture& texture : scene.textures) different.insert(texture.rgba);
        return different.size();
    }
};

}  // namespace

TEST_F(GltfLimits, VerticesWithoutABufferViewCount) {
    nlohmann::json quad = writer.quad();
    writer.json["accessors"].push_back({{"componentType", 5126}, {"type", "VEC3"}, {"count", 100'000'002}});
    quad["attributes"] = {{"POSITION", writer.json["accessors"].size() - 1}};
    quad.erase("indices");
    writer.add_mesh_node(quad);
    EXPECT_NE(refused(LimitsOf({.memory = 1'000'000'000})).find("POSITION of 100000002 elements needs 1.2 GB"),
              std::string::npos);
    writer.json["accessors"].back()["count"] = 30'000;  // 0.36 MB as read, 2.3 MB as vertices
    EXPECT_NE(refused(LimitsOf({.memory = 2'000'000})).find("mesh 0 primitive 0 of 30000 vertices"), std::string::npos);
    EXPECT_EQ(load().triangle_count(), 10'000u);
}

TEST_F(GltfLimits, DescribedObjectsCount) {
    writer.add_mesh_node(writer.quad());
    for (int i = 0; i < 2000; ++i) writer.json["nodes"].push_back(nlohmann::json::object());
    EXPECT_NE(refused(LimitsOf({.memory = 1'000'000})).find("what it describes"), std::string::npos);
    EXPECT_EQ(load().triangle_count(), 2u);
}

TEST_F(GltfLimits, ManyCamerasOfOneNameTakeLinearTime) {
    constexpr size_t count = 20'000;
    nlohmann::json camera = {
        {"name", "c"}, {"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 1}, {"zfar", 9}}}};
    writer.json["cameras"] = nlohmann::json(count, camera);
    writer.json["nodes"] = nlohmann::json::array();
    writer.json["scenes"][0]["nodes"] = nlohmann::json::array();
    for (size_t i = 0; i < count; ++i)
        writer.json["nodes"].push_back({{"camera", i}}), writer.json["scenes"][0]["nodes"].push_back(i);
    const fs::path file = writer.write_glb(folder / "a.glb");
    const std::clock_t start = std::clock();
    const Scene scene = load_scene(file.string(), {});
    EXPECT_EQ(scene.cameras.back().name, "c_20000");
    EXPECT_LT(std::clock() - start, 6 * CLOCKS_PER_SEC);  // of the CPU; comparing each with each took 34 s
}

TEST_F(GltfLimits, TexturesOfOneImageShareIt) {
    add_textures(200, {128, 128});
    {
        const LimitsOf limits({.memory = 10'000'000});  // 200 copies of 64 kB take 13 MB
        const Scene scene = load();
        EXPECT_EQ(scene.textures.size(), 200u);
        EXPECT_EQ(count_texels(scene), 1u);
    }
    writer.json["images"] = nlohmann::json::array();
    for (size_t i = 0; i < 200; ++i) {
        writer.json["images"].push_back({{"uri", "t.png"}});
        writer.json["textures"][i]["source"] = i;
    }
    EXPECT_NE(refused(LimitsOf({.memory = 10'000'000})).find("image "), std::string::npos);
}

TEST_F(GltfLimits, OverridesShareWhatTheyChange) {
    add_textures(20, {64, 64});
    Scene scene = load();
    ChangedTexels changed;
    const auto override_with = [&](const nlohmann::json& entry) {
        JsonObject object(entry, "a.json");
        apply_override(object, scene, changed);
    };
    for (int i = 0; i < 20; ++i) override_with({{"material", "m" + std::to_string(i)}, {"roughness", 0.5}});
    EXPECT_EQ(scene.textures.size(), 40u);
    EXPECT_EQ(count_texels(scene), 2u);
    EXPECT_EQ(scene.textures.back().rgba->at(1), 255);
    EXPECT_NE(scene.textures.back().rgba->at(2), 255);
    override_with({{"material", ".*"}, {"metalness", 0.5}});
    EXPECT_EQ(count_texels(scene), 3u);
    const LimitsOf limits({.memory = 1000});
    EXPECT_NE(error_message([&] {
                  ChangedTexels none;
                  changed = none;
                  override_with({{"material", "m0"}, {"roughness", 1}});
              }).find("as an override changes it, needs"),
              std::string::npos);
}

TEST_F(GltfLimits, ImagesAreJudgedByTheirHeaders) {
    add_textures(1, {8, 8});
    const std::string png = read_text(folder / "t.png");
    const auto write_with_extent = [&](uint32_t width, uint32_t height) {
        constexpr size_t begin = 8, size = 4 + 4 + 13 + 4;  // of the first chunk, which begins with the extent
        const std::string rest = png.substr(begin + 8 + 8, 13 - 8);
        write_text(
            folder / "t.png",
            std::string(png).replace(
                begin, size, PngWriter::chunk("IHDR", PngWriter::integer(width) + PngWriter::integer(height) + rest)));
    };
    write_with_extent(20000, 8);
    EXPECT_NE(error_message([&] { load(); }).find("image 0 ('t.png') has 20000 x 8 pixels; allowed are sides of 16384"),
              std::string::npos);
    write_with_extent(16000, 16000);
    EXPECT_NE(refused(LimitsOf({.memory = 1'000'000'000})).find("pixels needs"), std::string::npos);
    // stb_image knows this one, too, and would read it.
    write_text(folder / "t.png", "P6\n2 2\n255\n" + std::string(12, '\x7F'));
    EXPECT_NE(error_message([&] { load(); }).find("it is a PPM; convert it: oiiotool t.png -o t.png"),
              std::string::npos);
}

TEST_F(GltfLimits, UrisStayBelowItsFolder) {
    const fs::path scene = folder / "scene";
    fs::create_directories(scene);
    add_textures(1, {2, 2});
    fs::copy(folder / "t.png", scene / "own.png");
    fs::create_symlink("../t.png", scene / "link.png");
    const auto load_with = [&](const std::string& uri) {
        writer.json["images"] = {{{"uri", uri}}};
        return load_gltf(writer.write_gltf(scene / "a.gltf"));
    };
    EXPECT_EQ(load_with("./own.png").textures.size(), 1u);
    for (const std::string uri : {"../t.png", "..%2Ft.png", "%2e%2e/t.png", "link.png", "own/../../t.png"}) {
        EXPECT_NE(error_message([&] { load_with(uri); }).find("is not below the folder of the file that names it"),
                  std::string::npos)
            << uri << ": " << error_message([&] { load_with(uri); });
    }
    EXPECT_NE(error_message([&] { load_with((folder / "t.png").string()); }).find("is not below"), std::string::npos);
    const LimitsOf limits({.memory = reading_limits().memory, .allows_outside = true});
    for (const std::string uri : {"../t.png", "..%2Ft.png", "link.png"})
        EXPECT_EQ(load_with(uri).textures.size(), 1u) << uri;
}

TEST_F(GltfLimits, FifosAreNotWaitedFor) {
    add_textures(1, {2, 2});
    fs::remove(folder / "t.png");
    ASSERT_EQ(mkfifo((folder / "t.png").c_str(), 0600), 0);
    EXPECT_NE(error_message([&] { load(); }).find("it is a FIFO, not a regular file"), std::string::npos);
}
