#include "core/files.h"
#include "tests/scene/gltf_fixture.h"

#include <png.h>
#include <cmath>

using nlohmann::json;

namespace {
/// A quad for each of the file's materials, so that all are drawn.
struct GltfExtensions : Gltf {
    Scene load_with_materials(const json& materials) {
        writer.json["materials"] = materials;
        writer.json["scenes"][0]["nodes"] = json::array();
        for (size_t i = 0; i < materials.size(); ++i) {
            json primitive = writer.quad();
            primitive["material"] = i;
            writer.json["scenes"][0]["nodes"].push_back(i);
            writer.add_mesh_node(primitive);
        }
        return load();
    }
    /// Adds an image of one texel row of RGBA codes, and a texture of it.
    int texture(const std::vector<uint8_t>& rgba) {
        const std::string name = "t" + std::to_string(writer.json["textures"].size()) + ".png";
        png_image image{};
        image.version = PNG_IMAGE_VERSION;
        image.width = unsigned(rgba.size() / 4), image.height = 1, image.format = PNG_FORMAT_RGBA;
        EXPECT_TRUE(png_image_write_to_file(&image, (folder / name).c_str(), 0, rgba.data(), 0, nullptr));
        writer.json["images"].push_back({{"uri", name}});
        writer.json["textures"].push_back({{"source", writer.json["images"].size() - 1}});
        return int(writer.json["textures"].size()) - 1;
    }
};

json with(const char* extension, const json& value) { return {{"extensions", {{extension, value}}}}; }

size_t warnings_about(const Scene& scene, int material) {
    return size_t(std::ranges::count(scene.warnings, material, &SceneWarning::material));
}
}  // namespace

/// F0 = ((n - 1) / (n + 1))^2, that of the specular colour times it, and an index of 0 for an infinite one
/// (KHR_materials_ior, KHR_materials_specular).
TEST_F(GltfExtensions, DielectricsReflectAsTheirIndexAndColourSay) {
    const int color = texture({255, 188, 0, 255}), factor = texture({0, 0, 0, 128});
    json all = with("KHR_materials_specular",
                    {{"specularFactor", 0.5},
                     {"specularColorFactor", {2, 0.5, 0.25}},
                     {"specularTexture", {{"index", factor}}},
                     {"specularColorTexture",
                      {{"index", color}, {"extensions", {{"KHR_texture_transform", {{"offset", {0.5, 0}}}}}}}}});
    all["extensions"]["KHR_materials_ior"] = {{"ior", 2.42}};
    const Scene scene =
        load_with_materials({with("KHR_materials_ior", {{"ior", 1.33}}), all, with("KHR_materials_ior", {{"ior", 0}}),
                             json::object(), with("KHR_materials_ior", {{"ior", 1.5}})});
    EXPECT_NEAR(scene.materials[0].dielectric_f0, 0.0201, 5e-5);
    const Material& m = scene.materials[1];
    EXPECT_NEAR(m.dielectric_f0, 0.1724, 5e-5);
    EXPECT_EQ(m.specular, 0.5f);
    EXPECT_EQ(m.specular_color, glm::vec3(2, 0.5f, 0.25f));
    EXPECT_FALSE(scene.textures.at(size_t(m.specular_texture.texture)).is_srgb);
    EXPECT_TRUE(scene.textures.at(size_t(m.specular_color_texture.texture)).is_srgb);
    EXPECT_EQ(m.specular_color_texture.uv_transform[2][0], 0.5f);
    EXPECT_EQ(scene.materials[2].dielectric_f0, 1.0f);
    for (const size_t usual : {3, 4}) EXPECT_EQ(scene.materials[usual].dielectric_f0, 0.04f);
    EXPECT_TRUE(scene.warnings.empty());
}

/// Converted as KHR_materials_specular says: a dielectric of base colour diffuse and F0 specular; roughness = 1 -
/// glossiness.
TEST_F(GltfExtensions, SpecularGlossinessIsADielectricOfThatColour) {
    const int specular = texture({255, 128, 0, 255, 255, 128, 0, 51}), diffuse = texture({10, 20, 30, 40});
    const Scene scene = load_with_materials(
        {with("KHR_materials_pbrSpecularGlossiness", {{"diffuseFactor", {0.5, 0.1, 0.1, 1}},
                                                      {"specularFactor", {0.04, 0.04, 0.04}},
                                                      {"glossinessFactor", 0.4}}),
         with("KHR_materials_pbrSpecularGlossiness", {{"diffuseTexture", {{"index", diffuse}}},
                                                      {"glossinessFactor", 0.5},
                                                      {"specularGlossinessTexture", {{"index", specular}}}}),
         with("KHR_materials_pbrSpecularGlossiness", json::object())});
    const Material& leather = scene.materials[0];
    expect_near(leather.base_color, {0.5f, 0.1f, 0.1f}, 0);
    EXPECT_EQ(leather.metalness, 0.0f);
    EXPECT_NEAR(leather.roughness, 0.6f, 1e-6f);
    expect_near(leather.dielectric_f0 * leather.specular_color, glm::vec3(0.04f), 0);
    const Material& mapped = scene.materials[1];
    EXPECT_EQ(mapped.dielectric_f0, 1.0f);
    EXPECT_TRUE(scene.textures.at(size_t(mapped.base_color_texture.texture)).is_srgb);
    EXPECT_TRUE(scene.textures.at(size_t(mapped.specular_color_texture.texture)).is_srgb);
    const Texture& rough = scene.textures.at(size_t(mapped.metalness_roughness_texture.texture));
    EXPECT_FALSE(rough.is_srgb);
    EXPECT_EQ(mapped.roughness, 1.0f);
    ASSERT_EQ(rough.channel_bytes, 2u);  // 8 bits do not hold 1 - 0.5 A
    uint16_t codes[8];
    std::memcpy(codes, rough.rgba->data(), sizeof(codes));
    EXPECT_NEAR(codes[1] / 65535.0, 0.5, 1e-5);
    EXPECT_NEAR(codes[5] / 65535.0, 0.9, 1e-5);
    EXPECT_EQ(scene.materials[2].roughness, 0.0f);
    EXPECT_TRUE(scene.warnings.empty());
}

TEST_F(GltfExtensions, EachInstanceIsPlacedBelowItsNode) {
    const int places = writer.floats({-1, 0, 0, 0, 2, 0, 1, 0, 0}, "VEC3");
    const std::vector<int8_t> turns = {0, 0, 90, 90, 0, 0, 0, 127, 0, 0, 0, 127};  // the first: a quarter turn about z
    const int view = writer.view(turns.data(), turns.size());
    writer.json["accessors"].push_back(
        {{"bufferView", view}, {"componentType", 5120}, {"normalized", true}, {"type", "VEC4"}, {"count", 3}});
    const int rotations = int(writer.json["accessors"].size()) - 1,
              scales = writer.floats({1, 1, 1, 2, 2, 2, 1, 1, 3}, "VEC3");
    writer.add_mesh_node(writer.quad());
    json& node = writer.json["nodes"][0];
    node["translation"] = {0, 0, 5};
    const auto with_attributes = [&](const json& attributes) {
        node["extensions"]["EXT_mesh_gpu_instancing"]["attributes"] = attributes;
    };
    with_attributes({{"TRANSLATION", places}, {"ROTATION", rotations}, {"SCALE", scales}, {"_ID", places}});
    const Scene scene = load();
    ASSERT_EQ(scene.instances.size(), 3u);
    const ScenePose pose = pose_scene(scene, 0);
    const auto corner = [&](size_t i) { return glm::vec3(pose.world_from_instance[i] * glm::vec4(1, 0, 0, 1)); };
    expect_near(corner(0), {-1, 1, 5}, 1e-6f);
    expect_near(corner(1), {2, 2, 5}, 1e-6f);
    expect_near(corner(2), {2, 0, 5}, 1e-6f);
    EXPECT_TRUE(scene.warnings.empty());
    with_attributes({{"TRANSLATION", places}, {"SCALE", writer.floats({1, 1, 1}, "VEC3")}});
    EXPECT_NE(error_message([&] { load(); }).find("EXT_mesh_gpu_instancing: SCALE has 1 elements"), std::string::npos);
    with_attributes(json::object());
    EXPECT_NE(error_message([&] { load(); }).find("does not place its copies"), std::string::npos);
    with_attributes({{"TRANSLATION", writer.floats({0, 0, 1e10f}, "VEC3")}});
    EXPECT_NE(error_message([&] { load(); }).find("copy 0: TRANSLATION"), std::string::npos);
}

/// KHR_node_visibility: what hangs below a hidden node is hidden, lights too, but cameras are not.
TEST_F(GltfExtensions, HiddenNodesAreNotSeenNorWhatIsBelowThem) {
    writer.add_mesh_node(writer.quad());
    writer.json["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 0.1}}}}};
    writer.json["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}}};
    writer.json["nodes"] = {
        {{"mesh", 0}, {"children", {1, 2}}, {"extensions", {{"KHR_node_visibility", {{"visible", false}}}}}},
        {{"mesh", 0}, {"camera", 0}, {"extensions", {{"KHR_node_visibility", {{"visible", true}}}}}},
        {{"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}},
        {{"mesh", 0}, {"extensions", {{"KHR_node_visibility", json::object()}}}}};
    writer.json["scenes"][0]["nodes"] = {0, 3};
    const Scene scene = load();
    ASSERT_EQ(scene.instances.size(), 1u);
    EXPECT_EQ(scene.cameras.size(), 1u);
    EXPECT_TRUE(scene.lights.empty());
    EXPECT_TRUE(scene.warnings.empty());
}

TEST_F(GltfExtensions, VariantsOfMaterialsAreChosenByName) {
    writer.json["materials"] = {{{"name", "day"}}, {{"name", "night"}}};
    writer.json["extensions"]["KHR_materials_variants"]["variants"] = {{{"name", "noon"}}, {{"name", "midnight"}}};
    json primitive = writer.quad();
    primitive["material"] = 0;
    primitive["extensions"]["KHR_materials_variants"]["mappings"] = {{{"material", 1}, {"variants", {1}}}};
    writer.add_mesh_node(primitive);
    writer.write_glb(folder / "a.glb");
    const auto shown = [&](const std::string& variant) {
        const Scene scene = load_gltf(folder / "a.glb", {.material_variant = variant});
        EXPECT_TRUE(scene.warnings.empty());
        return scene.materials[scene.meshes.at(0).material].name;
    };
    EXPECT_EQ(shown(""), "day");
    EXPECT_EQ(shown("noon"), "day");
    EXPECT_EQ(shown("midnight"), "night");
    const std::string said = error_message([&] { shown("midnigth"); });
    EXPECT_NE(said.find("did you mean 'midnight'"), std::string::npos) << said;
    EXPECT_NE(said.find("it has 'noon', 'midnight'"), std::string::npos) << said;
    write_text(folder / "scene.json", R"({"gltf": "a.glb", "material_variant": "midnight",
        "cameras": [{"name": "c", "vfov_deg": 40, "position": [0, 0, 2], "target": [0, 0, 0]}]})");
    const Scene scene = load_scene((folder / "scene.json").string(), {});
    EXPECT_EQ(scene.materials[scene.meshes.at(0).material].name, "night");
}

/// What is not read and changes the picture is said of each material that has it; a factor of 0 changes nothing.
TEST_F(GltfExtensions, WhatIsLeftOutIsSaidOfEachMaterial) {
    const json kinds = {{"KHR_materials_transmission", {{"transmissionFactor", 0.5}}},
                        {"KHR_materials_diffuse_transmission", {{"diffuseTransmissionFactor", 0.5}}},
                        {"KHR_materials_clearcoat", {{"clearcoatFactor", 1}}},
                        {"KHR_materials_sheen", {{"sheenColorFactor", {0, 0, 1}}}},
                        {"KHR_materials_iridescence", {{"iridescenceFactor", 1}}},
                        {"KHR_materials_anisotropy", {{"anisotropyStrength", 0.5}}},
                        {"KHR_materials_of_tomorrow", json::object()}};
    json materials = json::array();
    for (const auto& [name, value] : kinds.items()) {
        materials.push_back(with(name.c_str(), value));
        materials.back()["name"] = "glass";
    }
    json thick = with("KHR_materials_volume", {{"thicknessFactor", 1}});
    materials.push_back(thick);  // of what lets no light through: without a trace
    thick["extensions"]["KHR_materials_transmission"] = {{"transmissionFactor", 1}};
    thick["extensions"]["KHR_materials_dispersion"] = {{"dispersion", 1}};
    materials.push_back(thick);
    json without = json::object();
    for (const auto& [name, value] : kinds.items())
        if (name != "KHR_materials_of_tomorrow") without["extensions"][name] = json::object();
    without["extensions"]["KHR_xmp_json_ld"] = {{"packet", 0}};
    materials.push_back(without);
    writer.json["extensionsUsed"] = {"KHR_materials_sheen", "KHR_xmp_json_ld"};  // others are met all the same
    const Scene scene = load_with_materials(materials);
    int material = 0;
    for (const auto& [name, value] : kinds.items()) {
        const auto said = std::ranges::find(scene.warnings, material, &SceneWarning::material);
        ASSERT_NE(said, scene.warnings.end()) << name;
        EXPECT_NE(said->text.find(name), std::string::npos) << said->text;
        EXPECT_NE(said->text.find("material 'glass'"), std::string::npos) << said->text;
        const bool is_known = name != "KHR_materials_of_tomorrow";
        EXPECT_EQ(said->text.find("(materials[" + std::to_string(material) + "])") != std::string::npos, is_known);
        ++material;
    }
    EXPECT_EQ(warnings_about(scene, material), 0u);      // volume alone
    EXPECT_EQ(warnings_about(scene, material + 1), 3u);  // transmission, volume, dispersion
    EXPECT_EQ(warnings_about(scene, material + 2), 0u);
    EXPECT_EQ(scene.warnings.size(), kinds.size() + 3);
    // A material that nothing shows has nothing to say.
    writer.json["scenes"][0]["nodes"] = {material};
    EXPECT_TRUE(load().warnings.empty());
}

/// A layer of a G-buffer has something there or nothing: blended surfaces are cut at an alpha of 0.5.
TEST_F(GltfExtensions, BlendedMaterialsAreCutWhereTheirAlphaIsBelowAHalf) {
    const int clear = texture({40, 160, 40, 255, 40, 160, 40, 0}), full = texture({40, 160, 40, 255, 0, 0, 0, 255});
    const auto blended = [](json material) {
        material["alphaMode"] = "BLEND";
        return material;
    };
    const json of_clear = {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", clear}}}}}},
               of_full = {{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", full}}}}}},
               thin = {{"pbrMetallicRoughness", {{"baseColorFactor", {1, 1, 1, 0.25}}}}};
    const Scene scene =
        load_with_materials({blended(of_clear), blended(of_full), blended(thin), blended(json::object())});
    const auto mode = [&](size_t i) { return scene.materials[i].alpha_mode; };
    EXPECT_EQ(mode(0), AlphaMode::mask);
    EXPECT_EQ(scene.materials[0].alpha_cutoff, 0.5f);
    EXPECT_EQ(mode(1), AlphaMode::opaque);
    EXPECT_EQ(mode(2), AlphaMode::mask);
    EXPECT_EQ(mode(3), AlphaMode::opaque);
    ASSERT_EQ(scene.warnings.size(), 2u);
    EXPECT_EQ(scene.warnings[0].material, 0);
    EXPECT_TRUE(
        mentions(scene.warnings, "'material_0' is blended (alphaMode BLEND) and drawn where its alpha is at least"));
    EXPECT_TRUE(mentions(scene.warnings, "it is invisible"));
    // Alpha of vertices alone.
    json primitive = writer.quad();
    primitive["material"] = 3;
    primitive["attributes"]["COLOR_0"] = writer.floats({1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 0, 1, 1, 1, 0}, "VEC4");
    writer.json["meshes"][3]["primitives"][0] = primitive;
    EXPECT_EQ(load().materials[3].alpha_mode, AlphaMode::mask);
    write_text(folder / "scene.json", R"({"gltf": "a.glb", "blended": "opaque",
        "cameras": [{"name": "c", "vfov_deg": 40, "position": [0, 0, 2], "target": [0, 0, 0]}]})");
    const Scene kept = load_scene((folder / "scene.json").string(), {});
    for (const Material& m : kept.materials) EXPECT_EQ(m.alpha_mode, AlphaMode::opaque);
    EXPECT_TRUE(mentions(kept.warnings, "is blended (alphaMode BLEND) and drawn opaque"));
}

/// A normal map bends normals the same way whether the file brings tangents (those of the coordinates as they are) or
/// they are derived, however KHR_texture_transform turns, mirrors and scales it.
TEST_F(GltfExtensions, TangentsTurnWithTheTexture) {
    const int normals = texture({204, 128, 230, 255});
    // A parallelogram whose u and v have different lengths, and w of either sign.
    const int positions = writer.floats({0, 0, 0, 2, 0, 0, 2.5f, 1, 0, 0.5f, 1, 0}, "VEC3");
    for (const float sign : {1.0f, -1.0f}) {
        json primitive = writer.quad();
        primitive["attributes"]["POSITION"] = positions;
        if (sign < 0) primitive["attributes"]["TEXCOORD_0"] = writer.floats({1, 1, 0, 1, 0, 0, 1, 0}, "VEC2");
        for (const bool has_tangents : {true, false}) {
            if (has_tangents) {
                std::vector<float> tangents;
                for (int i = 0; i < 4; ++i) tangents.insert(tangents.end(), {sign, 0, 0, sign});
                primitive["attributes"]["TANGENT"] = writer.floats(tangents, "VEC4");
            } else {
                primitive["attributes"].erase("TANGENT");
            }
            primitive["material"] = 0;
            writer.add_mesh_node(primitive);
        }
    }
    for (const json& transform :
         {json{{"rotation", 0.0}}, json{{"scale", {3, 0.5}}}, json{{"rotation", M_PI / 2}}, json{{"rotation", 0.7}},
          json{{"scale", {-1, 1}}}, json{{"rotation", 2.0}, {"scale", {2, -0.5}}}, json{{"scale", {-2, -1}}}}) {
        writer.json["materials"] = {
            {{"normalTexture", {{"index", normals}, {"extensions", {{"KHR_texture_transform", transform}}}}}}};
        const Scene scene = load();
        for (const size_t mesh : {0, 2})
            for (size_t i = 0; i < 4; ++i) {
                const glm::vec4 given = scene.meshes[mesh].vertices[i].tangent,
                                derived = scene.meshes[mesh + 1].vertices[i].tangent;
                expect_near(given, derived, 1e-5f);
                EXPECT_EQ(given.w, derived.w) << transform;
            }
        const glm::vec4 first = scene.meshes[0].vertices[0].tangent;
        // The texture's u' runs along -v where it is turned by a quarter, and v points down.
        if (transform == json{{"rotation", M_PI / 2}}) {
            expect_near(first, -glm::normalize(glm::vec3(0.5f, 1, 0)), 1e-5f);
        } else if (transform == json{{"scale", {-1, 1}}}) {
            EXPECT_EQ(first.w, -1.0f);
        } else if (transform == json{{"scale", {3, 0.5}}}) {
            EXPECT_EQ(first, glm::vec4(1, 0, 0, 1));
        }
    }
}

/// "Khronos glTF Blender I/O" multiplies lights by 683, and nothing else; ssrlab reads W/m^2.
TEST_F(GltfExtensions, BlendersUnitsOfLightAreSaid) {
    writer.add_mesh_node(writer.quad());
    writer.json["asset"]["generator"] = "Khronos glTF Blender I/O v3.4.50";
    EXPECT_TRUE(load().warnings.empty());
    writer.json["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "directional"}, {"intensity", 683}}};
    EXPECT_TRUE(load().warnings.empty());  // a light of no node
    writer.json["nodes"].push_back({{"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
    writer.json["scenes"][0]["nodes"] = {0, 1};
    const Scene scene = load();
    ASSERT_EQ(scene.warnings.size(), 1u);
    EXPECT_NE(scene.warnings[0].text.find("683"), std::string::npos);
    EXPECT_EQ(scene.lights.at(0).intensity, glm::vec3(683));
    write_text(folder / "scene.json", R"({"gltf": "a.glb", "light_scale": 0.00146413,
        "cameras": [{"name": "c", "vfov_deg": 40, "position": [0, 0, 2], "target": [0, 0, 0]}]})");
    const Scene scaled = load_scene((folder / "scene.json").string(), {});
    EXPECT_NEAR(scaled.lights.at(0).intensity.x, 1, 1e-5);
    EXPECT_TRUE(scaled.warnings.empty());
    writer.json["asset"]["generator"] = "other";
    EXPECT_TRUE(load().warnings.empty());
}

/// Before 3.4.40 a sun of 1 W/m^2 is written as 1, and a lamp of 100 W as 100 instead of 100 / (4 pi) W/sr.
TEST_F(GltfExtensions, OlderUnitsOfBlendersLightsAreSaid) {
    writer.add_mesh_node(writer.quad());
    writer.json["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "directional"}, {"intensity", 1}},
                                                                  {{"type", "point"}, {"intensity", 100}}};
    for (int light = 0; light < 2; ++light)
        writer.json["nodes"].push_back({{"extensions", {{"KHR_lights_punctual", {{"light", light}}}}}});
    const auto said = [&](const char* version, std::vector<int> nodes) {
        writer.json["asset"]["generator"] = std::string("Khronos glTF Blender I/O") + version;
        writer.json["scenes"][0]["nodes"] = nodes;
        std::string text;
        for (const SceneWarning& warning : load().warnings) text += warning.text;
        return text;
    };
    EXPECT_EQ(said(" v3.4.39", {0, 1}), "");
    EXPECT_NE(said(" v3.4.39", {0, 2}).find("\"light_scale\": 0.0795775"), std::string::npos);
    EXPECT_NE(said(" v1.8.19", {0, 1, 2}).find("newer version"), std::string::npos);
    EXPECT_NE(said("", {0, 2}).find("before 3.4.40"), std::string::npos);  // no version counts as an old one
    for (const char* version : {" v3.4.40", " v3.5.0", " v4.0.1", " v10.0.0"})
        EXPECT_NE(said(version, {0, 1}).find("683"), std::string::npos) << version;
    EXPECT_NEAR(1 / (4 * M_PI), 0.0795775, 1e-7);  // half of its last digit
}

TEST_F(GltfExtensions, WhatElseIsLeftOutIsSaidWhereItIs) {
    writer.json["materials"] = {{{"name", "lamp"}, {"occlusionTexture", {{"index", texture({0, 0, 0, 255})}}}}};
    json primitive = writer.quad();
    primitive["material"] = 0;
    writer.add_mesh_node(primitive);
    const int times = writer.floats({0, 1}, "SCALAR"), values = writer.floats({0, 1}, "SCALAR");
    const auto channel = [](const std::string& pointer) {
        return json{
            {"sampler", 0},
            {"target", {{"path", "pointer"}, {"extensions", {{"KHR_animation_pointer", {{"pointer", pointer}}}}}}}};
    };
    writer.json["animations"] = {
        {{"name", "pulse"},
         {"samplers", {{{"input", times}, {"output", values}}}},
         {"channels",
          {channel("/materials/0/emissiveFactor"), channel("/nodes/0/extensions/KHR_node_visibility/visible")}}}};
    writer.json["scenes"][0]["extensions"]["EXT_lights_image_based"] = {{"light", 0}};
    writer.json["nodes"][0]["extensions"] = {{"MSFT_lod", {{"ids", {1}}}}, {"EXT_unheard_of", json::object()}};
    const Scene scene = load();
    EXPECT_EQ(scene.warnings.size(), 5u);
    EXPECT_EQ(warnings_about(scene, 0), 1u);
    EXPECT_TRUE(mentions(scene.warnings, "moves /materials/0/emissiveFactor of material 'lamp'"));
    EXPECT_EQ(std::ranges::count(scene.warnings, 0, &SceneWarning::node), 1);
    EXPECT_TRUE(mentions(scene.warnings, "Occlusion textures (of 'lamp') are left out"));
    EXPECT_TRUE(mentions(scene.warnings, "EXT_lights_image_based"));
    EXPECT_TRUE(mentions(scene.warnings, "The glTF extension EXT_unheard_of of node"));
}

/// A whole number may be written as a decimal (JSON knows one kind of number), and what has another type is named.
TEST_F(GltfExtensions, MembersOfOtherTypesAreRefusedByKey) {
    const auto refuses = [&](const json& materials, const std::string& what) {
        const std::string said = error_message([&] { load_with_materials(materials); });
        EXPECT_NE(said.find(what), std::string::npos) << said;
        writer = {};
    };
    refuses(json::array({with("KHR_materials_ior", {{"ior", "1.5"}})}),
            "materials[0].extensions.KHR_materials_ior.ior: must be a number, not \"1.5\"");
    refuses(json::array({with("KHR_materials_ior", {{"ior", -1}})}), "ior = -1 is outside");
    refuses(json::array({with("KHR_materials_specular", {{"specularColorFactor", {1, 1}}})}),
            "KHR_materials_specular.specularColorFactor: must be an array of 3 numbers");
    refuses(json::array({with("KHR_materials_specular", {{"specularColorFactor", {1, -1, 1}}})}),
            "specularColorFactor = -1 is outside");
    refuses(json::array({with("KHR_materials_specular", {{"specularTexture", {{"index", 7}}}})}),
            "texture 7 does not exist");
    refuses(json::array({with("KHR_materials_pbrSpecularGlossiness", {{"glossinessFactor", 2}})}),
            "glossinessFactor = 2 is outside");
    refuses(json::array({with("KHR_materials_clearcoat", {{"clearcoatFactor", {1}}})}),
            "clearcoatFactor: must be a number, not [1]");
}
