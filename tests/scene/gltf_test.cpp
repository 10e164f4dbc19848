#include "core/error.h"
#include "core/files.h"
#include "core/png.h"
#include "core/scene/load_scene.h"
#include "tests/scene/gltf_fixture.h"

#include <gtest/gtest.h>
#include <cmath>
#include <fstream>
#include <random>

namespace fs = std::filesystem;

TEST_F(Gltf, ReadsBothContainersAlike) {
    writer.add_mesh_node(writer.quad());
    const Scene binary = load(), text = load_gltf(writer.write_gltf(folder / "b.gltf"));
    EXPECT_EQ(binary.triangle_count(), 2u);
    EXPECT_EQ(binary.content_hash, text.content_hash);
    EXPECT_TRUE(binary.warnings.empty());
}

TEST_F(Gltf, MaterialsFollowTheExtensions) {
    writer.json["materials"] = {
        {{"name", "m"},
         {"pbrMetallicRoughness",
          {{"baseColorFactor", {0.5, 0.25, 1.0, 1.0}}, {"metallicFactor", 0.25}, {"roughnessFactor", 0.75}}},
         {"emissiveFactor", {1, 0.5, 0}},
         {"alphaMode", "MASK"},
         {"alphaCutoff", 0.3},
         {"doubleSided", true},
         {"extensions",
          {{"KHR_materials_emissive_strength", {{"emissiveStrength", 8}}},
           {"KHR_materials_specular", {{"specularFactor", 0.5}}},
           {"KHR_materials_sheen", {{"sheenColorFactor", {0, 0, 1}}}}}}},
        {{"name", "flat"}, {"extensions", {{"KHR_materials_unlit", nlohmann::json::object()}}}}};
    writer.json["extensionsUsed"] = {"KHR_materials_emissive_strength", "KHR_materials_specular", "KHR_materials_unlit",
                                     "KHR_materials_sheen"};
    nlohmann::json primitive = writer.quad();
    primitive["material"] = 0;
    writer.add_mesh_node(primitive);
    const Scene scene = load();
    const Material& m = scene.materials.at(0);
    expect_near(m.base_color, {0.5f, 0.25f, 1.0f}, 0);
    expect_near(m.emission, {8, 4, 0}, 0);
    EXPECT_EQ(m.metalness, 0.25f);
    EXPECT_EQ(m.roughness, 0.75f);
    EXPECT_EQ(m.specular, 0.5f);
    EXPECT_EQ(m.alpha_mode, AlphaMode::mask);
    EXPECT_EQ(m.alpha_cutoff, 0.3f);
    EXPECT_TRUE(m.is_double_sided);
    EXPECT_TRUE(scene.materials.at(1).is_unlit);
    EXPECT_TRUE(mentions(scene.warnings, "KHR_materials_sheen"));
}

TEST_F(Gltf, UnknownRequiredExtensionsAreRefused) {
    writer.add_mesh_node(writer.quad());
    writer.json["extensionsRequired"] = {"VENDOR_shapes"};
    EXPECT_NE(error_message([&] { load(); }).find("requires the glTF extension VENDOR_shapes"), std::string::npos);
}

TEST_F(Gltf, HierarchyAndAnimationPoseInstances) {
    writer.add_mesh_node(writer.quad());
    writer.json["nodes"] = {
        {{"children", {1}}, {"translation", {1, 0, 0}}, {"rotation", {0, 0, std::sqrt(0.5), std::sqrt(0.5)}}},
        {{"mesh", 0}, {"translation", {0, 2, 0}}, {"scale", {2, 2, -2}}}};
    const int times = writer.floats({0, 1}, "SCALAR"), values = writer.floats({1, 0, 0, 1, 0, 10}, "VEC3");
    writer.json["animations"] = {
        {{"samplers", {{{"input", times}, {"output", values}}}},
         {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}}}}}};
    Scene scene = load();
    scene.frame_rate = 10;
    const auto origin = [&](float frame) { return glm::vec3(pose_scene(scene, frame).world_from_instance.at(0)[3]); };
    // A quarter turn about z takes (0, 2, 0) to (-2, 0, 0).
    expect_near(origin(0), {-1, 0, 0}, 1e-6f);
    expect_near(origin(5), {-1, 0, 5}, 1e-6f);
    expect_near(origin(100), {-1, 0, 10}, 1e-6f);  // the last key holds
    EXPECT_LT(glm::determinant(pose_scene(scene, 0).world_from_instance.at(0)), 0.0f);
}

TEST_F(Gltf, DerivesTheTangentsOfAQuad) {
    writer.json["materials"] = {{{"normalTexture", {{"index", 0}}}}};
    writer.json["textures"] = {{{"source", 0}}};
    writer.json["images"] = {{{"uri", "n.png"}}};
    write_png(folder / "n.png", HostImage({1, 1}, 3, 0.5f));
    nlohmann::json primitive = writer.quad();
    primitive["material"] = 0;
    writer.add_mesh_node(primitive);
    const Scene scene = load();
    // +u runs along +x; glTF's v runs down while +Y of a normal map points up, so the bitangent is +y = cross(z, x): w
    // = 1.
    for (const Vertex& v : scene.meshes.at(0).vertices) {
        expect_near(v.tangent, {1, 0, 0}, 1e-6f);
        EXPECT_EQ(v.tangent.w, 1.0f);
    }
}

TEST_F(Gltf, TexturesKnowTheirColourSpace) {
    writer.json["materials"] = {
        {{"pbrMetallicRoughness",
          {{"baseColorTexture", {{"index", 0}}},
           {"metallicRoughnessTexture",
            {{"index", 0}, {"extensions", {{"KHR_texture_transform", {{"offset", {0.5, 0}}, {"scale", {2, 3}}}}}}}}}}}};
    writer.json["textures"] = {{{"source", 0}}};
    writer.json["images"] = {{{"uri", "t.png"}}};
    write_png(folder / "t.png", HostImage({2, 1}, 3, 0.25f));
    nlohmann::json primitive = writer.quad();
    primitive["material"] = 0;
    writer.add_mesh_node(primitive);
    const Scene scene = load();
    const Material& m = scene.materials.at(0);
    EXPECT_TRUE(scene.textures.at(size_t(m.base_color_texture.texture)).is_srgb);
    EXPECT_FALSE(scene.textures.at(size_t(m.metalness_roughness_texture.texture)).is_srgb);
    expect_near(m.metalness_roughness_texture.uv_transform * glm::vec3(1, 1, 1), {2.5f, 3, 1}, 1e-6f);
    EXPECT_NEAR(linear_from_srgb(float(scene.textures.at(size_t(m.base_color_texture.texture)).rgba->at(0)) / 255.0f),
                0.25f, 0.005f);  // one code near 137 is 0.004
}

TEST_F(Gltf, MissingNormalsAreFlat) {
    nlohmann::json primitive = {
        {"attributes", {{"POSITION", writer.floats({0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}, "VEC3")}}},
        {"indices", writer.indices({0, 1, 2, 0, 3, 1})}};
    writer.add_mesh_node(primitive);
    const Scene scene = load();
    ASSERT_EQ(scene.meshes.at(0).vertices.size(), 6u);
    expect_near(scene.meshes[0].vertices[0].normal, {0, 0, 1}, 1e-6f);
    expect_near(scene.meshes[0].vertices[3].normal, {0, 1, 0}, 1e-6f);
}

TEST_F(Gltf, BrokenFilesAreErrors) {
    writer.add_mesh_node(writer.quad());
    writer.write_gltf(folder / "b.gltf");
    fs::remove(folder / "b.bin");
    EXPECT_NE(error_message([&] { load_gltf(folder / "b.gltf"); }).find("b.gltf"), std::string::npos);
    EXPECT_NE(error_message([&] { load_gltf(folder / "none.glb"); }).find("none.glb"), std::string::npos);
    writer.json["accessors"][3]["count"] = 7;  // indices beyond the buffer
    EXPECT_NE(error_message([&] { load(); }), "no error");
    writer.json["accessors"][3]["count"] = 6;
    writer.json["nodes"][0]["children"] = {0};
    EXPECT_NE(error_message([&] { load(); }), "no error");
    writer.json["nodes"][0] = {{"mesh", 5}};
    EXPECT_NE(error_message([&] { load(); }), "no error");
}

TEST_F(Gltf, NumbersThatOverflowAreRefusedByKey) {
    const auto refuses = [&](const std::string& what) {
        const std::string said = error_message([&] { load_scene(writer.write_glb(folder / "a.glb").string(), {}); });
        EXPECT_NE(said.find("a.glb"), std::string::npos) << said;
        EXPECT_NE(said.find(what), std::string::npos) << said;
    };
    writer.json["materials"] = {{{"name", "lamp"}}};
    nlohmann::json primitive = writer.quad();
    primitive["material"] = 0;
    writer.add_mesh_node(primitive);
    const nlohmann::json whole = writer.json;
    const auto set = [&](const char* at, const nlohmann::json& value) {
        writer.json = whole;
        writer.json[nlohmann::json::json_pointer(at)] = value;
    };
    set("/nodes/0/translation", {3e38, 0, 0}), refuses("node 0 (''): translation");
    set("/nodes/0/scale", {1, -2e9, 1}), refuses("node 0 (''): scale");
    set("/nodes/0/matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 1e10, 0, 0, 1}), refuses("node 0 (''): matrix");
    // Each is in range, their product is not.
    set("/nodes", {{{"children", {1}}, {"scale", {1e6, 1, 1}}}, {{"mesh", 0}, {"scale", {1e6, 1, 1}}}});
    refuses("node 1 (''): its transform times those of its parents");
    set("/materials/0/emissiveFactor", {1, 1, 1});
    writer.json["materials"][0]["extensions"]["KHR_materials_emissive_strength"]["emissiveStrength"] = 3e38;
    refuses("material 'lamp': the product of emissiveFactor and emissiveStrength");
    writer.json = whole;
    writer.json["meshes"][0]["primitives"][0]["attributes"]["POSITION"] =
        writer.floats({0, 0, 0, 1, 0, 0, 1, 1e10f, 0, 0, 1, 0}, "VEC3");
    refuses("mesh 0 primitive 0 POSITION: element 2");
    // A number that no float64 holds; tinygltf would take infinity.
    writer.json = whole;
    std::string text = read_text(writer.write_gltf(folder / "a.gltf"));
    text.replace(text.find("\"lamp\""), 6, "\"lamp\", \"alphaCutoff\": 1e999");
    write_text(folder / "a.gltf", text);
    EXPECT_NE(error_message([&] { load_gltf(folder / "a.gltf"); }).find("materials[0]: alphaCutoff: the number 1e999"),
              std::string::npos)
        << error_message([&] { load_gltf(folder / "a.gltf"); });
    // Squares of the quaternion's parts overflow, but the rotation is clear.
    set("/nodes/0/rotation", {0, 0, 1e30, 1e30});
    const glm::vec4 rotation = load().nodes.at(0).rotation;
    EXPECT_NEAR(rotation.z, std::sqrt(0.5f), 1e-6f);
    EXPECT_NEAR(rotation.w, std::sqrt(0.5f), 1e-6f);
}

TEST_F(Gltf, LimitsHoldUpToARoundingOfFloat32) {
    writer.json["materials"] = {{{"name", "m"}}};
    nlohmann::json primitive = writer.quad();
    primitive["material"] = 0;
    writer.add_mesh_node(primitive);
    writer.json["nodes"][0]["extensions"]["KHR_lights_punctual"]["light"] = 0;
    nlohmann::json& light = writer.json["extensions"]["KHR_lights_punctual"]["lights"][0];
    light = {{"type", "spot"}, {"spot", nlohmann::json::object()}};
    nlohmann::json& pbr = writer.json["materials"][0]["pbrMetallicRoughness"];
    pbr = nlohmann::json::object();
    const auto said = [&] { return error_message([&] { load(); }); };

    light["spot"]["outerConeAngle"] = 1.5707963705062866;  // pi / 2 as float32, 4.4e-8 above it
    const float cosine = load().lights.at(0).outer_cone_cos;
    light["spot"]["outerConeAngle"] = 1.5707963267948966;
    EXPECT_EQ(load().lights.at(0).outer_cone_cos, cosine);
    light["spot"]["outerConeAngle"] = 1.5707968;  // three roundings beyond
    EXPECT_NE(said().find("light 0: outerConeAngle"), std::string::npos) << said();
    light["spot"] = {{"outerConeAngle", 0.5}, {"innerConeAngle", 0.50000006}};
    EXPECT_EQ(load().lights.at(0).inner_cone_cos, load().lights.at(0).outer_cone_cos);

    pbr = {{"metallicFactor", 1.0000001}, {"roughnessFactor", -1e-45}, {"baseColorFactor", {1.0000001, 1, 1, 1}}};
    const Material m = load().materials.at(0);
    EXPECT_EQ(m.metalness, 1.0f);
    EXPECT_EQ(m.roughness, 0.0f);
    EXPECT_EQ(m.base_color.x, 1.0f);
    pbr = {{"metallicFactor", 1.000001}};
    EXPECT_NE(said().find("metallicFactor"), std::string::npos);
}

TEST_F(Gltf, OneOfSeveralScenesIsShownAndSaid) {
    for (int i = 0; i < 2; ++i) writer.add_mesh_node(writer.quad());
    writer.json["scenes"] = {{{"name", "hall"}, {"nodes", {0, 1}}}, {{"nodes", {1}}}};
    writer.json.erase("scene");
    EXPECT_EQ(load().triangle_count(), 4u);  // the first, where the file does not say
    EXPECT_TRUE(mentions(load().warnings, "Of the 2 scenes of the file, 'hall' is shown."));
    writer.json["scene"] = 1;
    EXPECT_EQ(load().triangle_count(), 2u);
    EXPECT_TRUE(mentions(load().warnings, "Of the 2 scenes of the file, scenes[1] is shown."));
    writer.json.erase("scenes"), writer.json.erase("scene");
    const Scene all = load();
    EXPECT_EQ(all.triangle_count(), 4u);
    EXPECT_TRUE(all.warnings.empty());
}

TEST_F(Gltf, ExtensionsAreReportedWhereTheyStand) {
    writer.json["materials"] = {{{"name", "m"}}};
    nlohmann::json primitive = writer.quad();
    primitive["material"] = 0;
    writer.add_mesh_node(primitive);
    // Listed and nowhere met, or of no effect on what is drawn: no word.
    writer.json["extensionsUsed"] = {"KHR_materials_clearcoat", "KHR_xmp_json_ld", "AGI_articulations"};
    writer.json["extensions"]["VENDOR_library"] = {{"things", {1, 2}}};
    writer.json["asset"]["extensions"]["KHR_xmp_json_ld"] = {{"packet", 0}};
    writer.json["nodes"][0]["extensions"]["AGI_articulations"] = {{"articulationName", "a"}};
    writer.json["nodes"][0]["extensions"]["MSFT_lod"] = {{"ids", {0}}};
    writer.json["nodes"][0]["extras"]["extensions"]["VENDOR_note"] = 1;
    EXPECT_TRUE(load().warnings.empty()) << load().warnings.front().text;
    // Met, listed or not.
    writer.json["nodes"][0]["extensions"]["VENDOR_bend"] = {{"angle", 1}};
    writer.json["scenes"][0]["extensions"]["EXT_lights_image_based"] = {{"light", 0}};
    for (int i = 0; i < 5; ++i) writer.json["nodes"].push_back({{"extensions", {{"VENDOR_hop", {{"n", i}}}}}});
    const Scene scene = load();
    EXPECT_TRUE(mentions(scene.warnings, "The glTF extension VENDOR_bend of node 0 is ignored."));
    EXPECT_TRUE(mentions(scene.warnings, "The glTF extension VENDOR_hop of 5 nodes (1, 2, 3, ...) is ignored."));
    EXPECT_TRUE(mentions(scene.warnings, "light from images (EXT_lights_image_based) is not read"));
    writer.json["extensionsRequired"] = {"KHR_texture_basisu"};
    EXPECT_NE(error_message([&] { load(); })
                  .find("requires the glTF extension KHR_texture_basisu, which ssrlab does not "
                        "support; `gltf-transform ktxdecompress"),
              std::string::npos);
}

TEST_F(Gltf, AnimationOutOfRangeIsRefusedWhereItIs) {
    writer.add_mesh_node(writer.quad());
    const int times = writer.floats({0, 1}, "SCALAR"), values = writer.floats({1, 0, 0, 1e20f, 0, 0}, "VEC3");
    writer.json["animations"] = {
        {{"samplers", {{{"input", times}, {"output", values}}}},
         {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "translation"}}}}}}}};
    const Scene scene = load();
    EXPECT_NO_THROW(pose_scene(scene, 0));
    EXPECT_NE(error_message([&] { pose_scene(scene, 10); }).find("at frame 10 animation moves node ''"),
              std::string::npos);
}

TEST_F(Gltf, CamerasAndLightsNeedAnOrientation) {
    writer.add_mesh_node(writer.quad());
    writer.json["cameras"] = {{{"name", "c"}, {"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 0.1}}}}};
    writer.json["nodes"].push_back({{"camera", 0}, {"scale", {1, 1, 0}}});
    writer.json["scenes"][0]["nodes"] = {0, 1};
    const auto load_whole = [&] { load_scene(writer.write_glb(folder / "a.glb").string(), {}); };
    EXPECT_NE(error_message(load_whole).find("camera 'c' hangs on a node with a scale of 0"), std::string::npos);
    writer.json["nodes"][1] = {{"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}, {"scale", {1, 1, 0}}};
    writer.json["extensionsUsed"] = {"KHR_lights_punctual"};
    writer.json["extensions"]["KHR_lights_punctual"]["lights"] = {{{"name", "sun"}, {"type", "directional"}}};
    EXPECT_NE(error_message(load_whole).find("light 'sun' hangs on a node with a scale of 0"), std::string::npos);
}

TEST_F(Gltf, DeepOrRepeatedKeysEndInASentence) {
    writer.add_mesh_node(writer.quad());
    const std::string text = read_text(writer.write_gltf(folder / "a.gltf"));
    const std::string brackets = std::string(300'000, '[') + std::string(300'000, ']');
    write_text(folder / "deep.gltf", "{\"extras\": " + brackets + "," + text.substr(text.find('{') + 1));
    EXPECT_EQ(error_message([&] { load_gltf(folder / "deep.gltf"); }),
              (folder / "deep.gltf").string() + ": its JSON nests more than 100 levels");
    write_text(folder / "twice.gltf", "{\"nodes\": []," + text.substr(text.find('{') + 1));
    EXPECT_EQ(error_message([&] { load_gltf(folder / "twice.gltf"); }),
              (folder / "twice.gltf").string() + ": the key 'nodes' comes twice in one object");
}

TEST_F(Gltf, DamagedFilesNeverCrash) {
    writer.add_mesh_node(writer.quad());
    writer.write_glb(folder / "a.glb");
    const std::string whole = read_text(folder / "a.glb");
    std::mt19937 random(5);
    size_t refused = 0;
    for (int i = 0; i < 400; ++i) {
        std::string damaged = whole;
        if (i % 2)
            damaged.resize(random() % damaged.size());
        else
            for (int flips = 0; flips < 3; ++flips) damaged[random() % damaged.size()] ^= char(1u << random() % 8);
        write_text(folder / "d.glb", damaged);
        try {
            load_gltf(folder / "d.glb");
        } catch (const Error&) {
            ++refused;
        }
    }
    EXPECT_GE(refused, 200u);  // every truncated one, at least
}

TEST(ThirdPartyScenes, LoadWithWarningsThatAreUnderstood) {
    // Runs where SSRLAB_SCENE_PATH names the folder of the files that scenes/README.md lists.
    if (!std::getenv("SSRLAB_SCENE_PATH")) GTEST_SKIP() << "SSRLAB_SCENE_PATH is not set";
    const auto path = scene_search_path();
    for (const std::string& name : list_scenes(path)) try {
            const Scene scene = load_scene(name, path);
            std::printf("%s: %zu triangles, %zu materials, %zu textures\n", name.c_str(), scene.triangle_count(),
                        scene.materials.size(), scene.textures.size());
            for (const SceneWarning& warning : scene.warnings) std::printf("  %s\n", warning.text.c_str());
        } catch (const Error& e) {
            EXPECT_NE(std::string(e.what()).find("search path"), std::string::npos) << name << ": " << e.what();
        }
}
