// Names of views: which part is the scene's where names have dots in them, or look like a scene of a family.
#include "experiments/study/view_name.h"

#include "core/error.h"
#include "core/files.h"
#include "tests/error_message.h"

#include <gtest/gtest.h>
#include <unistd.h>

namespace fs = std::filesystem;

namespace {

struct ViewNames : testing::Test {
    fs::path folder = fs::temp_directory_path() / "view_names";

    void TearDown() override { fs::remove_all(folder); }
    /// A scene with a camera. Of several that fit a name cameras decide, for which they are loaded: one triangle.
    void add_scene(const std::string& name, const std::string& camera) {
        write_text(folder / name / "scene.gltf",
                   R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
            "nodes": [{"mesh": 0}], "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
            "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]}],
            "bufferViews": [{"buffer": 0, "byteLength": 36}], "buffers": [{"byteLength": 36, "uri": "scene.bin"}]})");
        const float corners[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
        write_text(folder / name / "scene.bin", {reinterpret_cast<const char*>(corners), sizeof corners});
        write_text(folder / name / "scene.json", R"({"gltf": "scene.gltf", "environment": {"constant": [1, 1, 1]},
            "cameras": [{"name": ")" + camera + R"(", "position": [0, 0, 3], "target": [0, 0, 0], "vfov_deg": 45}]})");
    }
    /// "SCENE|CAMERA"
    std::string parts(const std::string& names) {
        const ViewName name = view_name(names, "frames/" + names + ".48x27", {folder});
        return name.scene + "|" + name.camera;
    }
};

}  // namespace

TEST_F(ViewNames, TheLongestKnownSceneIsMeant) {
    for (const char* name : {"Lamp_v1.2", "a.b.c", "street_42", "room"})
        write_text(folder / name / "scene.json", "not read");
    EXPECT_EQ(parts("Lamp_v1.2.main"), "Lamp_v1.2|main");
    EXPECT_EQ(parts("a.b.c.over.head"), "a.b.c|over.head");
    EXPECT_EQ(parts("room.main"), "room|main");
    EXPECT_EQ(parts("room_17.path"), "room:17|path");
    EXPECT_EQ(parts("street_42.main"), "street_42|main") << "a folder of that name";
    EXPECT_EQ(parts("street_43.main"), "street:43|main");
}

TEST_F(ViewNames, CamerasDecideBetweenScenesThatBothFit) {
    add_scene("a", "b.main"), add_scene("a.b", "side");
    EXPECT_EQ(parts("a.b.main"), "a|b.main");
    EXPECT_EQ(parts("a.b.side"), "a.b|side");
    EXPECT_EQ(parts("a.b.top"), "a.b|top") << "neither has it: the longest";
}

TEST_F(ViewNames, WhatNoSceneBeginsIsOfACaptureIfItsCameraIs) {
    write_text(folder / "known" / "scene.json", "not read");
    const auto is_of_capture = [&](const std::string& names) {
        return view_name(names, "frames/" + names, {folder}).is_of_capture;
    };
    EXPECT_EQ(parts("my.capture.gbuffer"), "my.capture|gbuffer");
    EXPECT_TRUE(is_of_capture("my.capture.gbuffer"));
    EXPECT_FALSE(is_of_capture("known.gbuffer")) << "a camera of a scene";
    EXPECT_FALSE(is_of_capture("room_17.gbuffer"));
}

TEST_F(ViewNames, UnknownScenesSayWhereTheNameWasCut) {
    write_text(folder / "Lamp_v1.2" / "scene.json", "not read");
    const std::string text = error_message([&] { parts("Lamp_v1.3.main"); });
    for (const char* part :
         {"frames/Lamp_v1.3.main.48x27: ", "cut at the first dot it has the scene 'Lamp_v1' and the camera '3.main'",
          "--scene", "did you mean 'Lamp_v1.2'?"})
        EXPECT_NE(text.find(part), std::string::npos) << text;
    for (const char* name : {"street_lamp.main", "streets_42.main", "street_1234567.main"})
        EXPECT_NE(error_message([&] { parts(name); }).find("no known scene"), std::string::npos) << name;
}
