#include "core/files.h"
#include "tests/scene/gltf_fixture.h"

namespace {

/// A file that uses each key once.
nlohmann::json whole_gltf() {
    return nlohmann::json::parse(R"({
        "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0, 1]}], "extensionsUsed": ["KHR_lights_punctual"],
        "extensions": {"KHR_lights_punctual": {"lights": [{"type": "point", "color": [1, 1, 1], "intensity": 1}]}},
        "nodes": [{"mesh": 0, "translation": [0, 0, 0], "rotation": [0, 0, 0, 1], "scale": [1, 1, 1]},
                  {"children": [2], "camera": 0}, {"matrix": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0, "mode": 4}]}],
        "accessors": [{"componentType": 5126, "type": "VEC3", "count": 3, "byteOffset": 0, "normalized": false},
                      {"componentType": 5126, "type": "SCALAR", "count": 2}],
        "bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": 4}],
        "buffers": [{"byteLength": 4, "uri": "data:application/octet-stream;base64,AAAAAA=="}],
        "textures": [{}], "samplers": [{"wrapS": 10497}],
        "cameras": [{"type": "perspective", "perspective": {"yfov": 1, "znear": 0.1}}],
        "materials": [{"name": "m", "pbrMetallicRoughness": {"roughnessFactor": 1, "baseColorFactor": [1, 1, 1, 1],
                       "baseColorTexture": {"index": 0, "texCoord": 0}}, "emissiveFactor": [0, 0, 0],
                       "alphaMode": "OPAQUE", "alphaCutoff": 0.5, "doubleSided": true,
                       "extensions": {"KHR_materials_specular": {"specularFactor": 1}}}],
        "animations": []})");
}

}  // namespace

TEST_F(Gltf, ValuesOfOtherTypesAreNamedByTheirPath) {
    const auto said = [&](const nlohmann::json& json) {
        write_text(folder / "a.gltf", json.dump());
        return error_message([&] { load_gltf(folder / "a.gltf"); });
    };
    ASSERT_EQ(said(whole_gltf()), "no error");
    const std::pair<const char*, const char*> wrong[] = {
        {"/asset", "1"},
        {"/asset/version", "2"},
        {"/asset/version", "\"3.0\""},
        {"/asset/version", "\"1.0\""},
        {"/asset/minVersion", "\"2.1\""},
        {"/scene", "\"a\""},
        {"/scene", "-1"},
        {"/scene", "0.5"},
        {"/scenes", "{}"},
        {"/scenes/0/nodes", "0"},
        {"/scenes/0/nodes/0", "\"0\""},
        {"/nodes/0", "[]"},
        {"/nodes/0/mesh", "-5"},
        {"/nodes/0/mesh", "\"0\""},
        {"/nodes/0/name", "1"},
        {"/nodes/0/translation", "[0, 0]"},
        {"/nodes/0/translation/1", "\"0\""},
        {"/nodes/0/rotation", "{}"},
        {"/nodes/0/scale", "2"},
        {"/nodes/1/children", "2"},
        {"/nodes/1/children/0", "\"1\""},
        {"/nodes/1/camera", "true"},
        {"/nodes/2/matrix/15", "null"},
        {"/meshes/0/primitives", "{}"},
        {"/meshes/0/primitives/0/attributes", "[]"},
        {"/meshes/0/primitives/0/attributes/POSITION", "\"0\""},
        {"/meshes/0/primitives/0/mode", "7"},
        {"/meshes/0/primitives/0/material", "[0]"},
        {"/meshes/0/primitives/0/indices", "false"},
        {"/accessors/0/componentType", "5130"},
        {"/accessors/0/type", "\"VEC5\""},
        {"/accessors/0/count", "-3"},
        {"/accessors/0/count", "3.5"},
        {"/accessors/0/normalized", "1"},
        {"/accessors/0/byteOffset", "\"0\""},
        {"/bufferViews/0/byteLength", "-1"},
        {"/bufferViews/0/buffer", "4294967296"},
        {"/buffers/0/uri", "1"},
        {"/samplers/0/wrapS", "1"},
        {"/textures/0/source", "\"0\""},
        {"/cameras/0/perspective", "[]"},
        {"/cameras/0/type", "\"wide\""},
        {"/cameras/0/perspective/yfov", "\"1\""},
        {"/materials/0/pbrMetallicRoughness", "\"x\""},
        {"/materials/0/pbrMetallicRoughness/roughnessFactor", "[1]"},
        {"/materials/0/pbrMetallicRoughness/baseColorFactor", "[1, 1, 1]"},
        {"/materials/0/pbrMetallicRoughness/baseColorTexture", "0"},
        {"/materials/0/pbrMetallicRoughness/baseColorTexture/texCoord", "\"0\""},
        {"/materials/0/pbrMetallicRoughness/baseColorTexture/extensions/KHR_texture_transform", "1"},
        {"/materials/0/emissiveFactor", "0"},
        {"/materials/0/alphaMode", "\"opaque\""},
        {"/materials/0/alphaCutoff", "\"1\""},
        {"/materials/0/doubleSided", "\"yes\""},
        {"/materials/0/extensions", "[]"},
        {"/materials/0/extensions/KHR_materials_specular/specularFactor", "\"1\""},
        {"/extensions/KHR_lights_punctual/lights", "{}"},
        {"/extensions/KHR_lights_punctual/lights/0/type", "\"sun\""},
        {"/extensions/KHR_lights_punctual/lights/0/intensity", "\"1\""},
        {"/extensionsUsed", "\"KHR\""},
        {"/extensionsRequired", "{}"},
        {"/animations", "{}"}};
    for (const auto& [pointer, value] : wrong) {
        nlohmann::json json = whole_gltf();
        json[nlohmann::json::json_pointer(pointer)] = nlohmann::json::parse(value);
        std::string path;  // "/nodes/1/children/0" as "nodes[1].children[0]: "
        for (std::istringstream steps(pointer + 1); steps.good();) {
            std::string step;
            std::getline(steps, step, '/');
            path += std::isdigit(step[0]) ? "[" + step + "]" : (path.empty() ? "" : ".") + step;
        }
        const std::string message = said(json);
        EXPECT_NE(message.find("a.gltf: " + path), std::string::npos) << pointer << ": " << message;
        EXPECT_NE(message.find("must be"), std::string::npos) << pointer << ": " << message;
    }
}

TEST_F(Gltf, WhatIsWantedIsSaid) {
    const auto said = [&](const char* pointer, const char* value) {
        nlohmann::json json = whole_gltf();
        json[nlohmann::json::json_pointer(pointer)] = nlohmann::json::parse(value);
        write_text(folder / "a.gltf", json.dump());
        const std::string message = error_message([&] { load_gltf(folder / "a.gltf"); });
        return message.substr(std::min(message.size(), (folder / "a.gltf").string().size() + 2));
    };
    EXPECT_EQ(said("/nodes/1/children", R"(["1"])"),
              R"(nodes[1].children[0]: must be a whole number from 0 to 2147483647, not "1")");
    EXPECT_EQ(said("/asset/version", R"("3.0")"), R"(asset.version: must be "2.0": ssrlab reads glTF 2, not "3.0")");
    EXPECT_EQ(said("/materials/0/pbrMetallicRoughness", R"("x")"),
              R"(materials[0].pbrMetallicRoughness: must be an object, not "x")");
    EXPECT_EQ(said("/bufferViews/0", R"({"buffer": 0})"), "bufferViews[0]: lacks the key 'byteLength'");
}
