#include "core/error.h"
#include "core/exr/exr.h"
#include "core/files.h"
#include "core/scene/camera.h"
#include "core/scene/load_scene.h"
#include "tests/error_message.h"
#include "tests/reading_limits.h"
#include "tests/scene/gltf_writer.h"

#include <gtest/gtest.h>
#include <algorithm>

namespace fs = std::filesystem;

namespace {

struct SceneFile : testing::Test {
    fs::path root = fs::temp_directory_path() / "scene_test";

    void SetUp() override {
        fs::remove_all(root);
        fs::create_directories(root / "room");
        GltfWriter writer;
        writer.json["materials"] = {{{"name", "floor"}, {"pbrMetallicRoughness", {{"roughnessFactor", 0.9}}}},
                                    {{"name", "glass"}}};
        nlohmann::json quad = writer.quad(), pane = writer.quad();
        quad["material"] = 0, pane["material"] = 1;
        writer.add_mesh_node(quad);
        writer.add_mesh_node(pane);
        writer.json["scenes"][0]["nodes"] = {0, 1};
        writer.write_glb(root / "room/room.glb");
    }
    void TearDown() override { fs::remove_all(root); }

    Scene load(const std::string& json) {
        write_text(root / "room/scene.json", json);
        return load_scene("room", {root});
    }
    std::string mistake(const std::string& json) {
        return error_message([&] { load(json); });
    }
};

const std::string camera =
    R"("cameras": [{"name": "main", "position": [0, 0, 3], "target": [0, 0, 0], "vfov_deg": 60}])";

}  // namespace

TEST_F(SceneFile, NamesEnvironmentLightsAndOverrides) {
    const Scene scene = load(
        R"({"gltf": "room.glb", "environment": {"gradient": {"color": [1, 1, 1], "slope": [0.5, 0.5, 0.5], "axis": [0, 2, 0]}},
        "lights": [{"type": "point", "position": [0, 1, 0], "color": [1, 0.5, 0.25], "intensity": 4}],
        "overrides": [{"material": "flo.*", "roughness": 0.1, "metalness": 1}, {"material": "glass", "hidden": true}], )" +
        camera + "}");
    EXPECT_EQ(scene.name, "room");
    EXPECT_EQ(scene.triangle_count(), 2u);  // the pane is hidden
    EXPECT_EQ(scene.materials[0].roughness, 0.1f);
    EXPECT_EQ(scene.materials[0].metalness, 1.0f);
    EXPECT_NEAR(scene.environment.radiance({0, 1, 0}).x, 1.5f, 1e-6f);
    EXPECT_EQ(scene.lights.at(0).intensity, glm::vec3(4, 2, 1));
    // By default near and far enclose the scene: its farthest corner from (0, 0, 3) is (1, 1, 0).
    EXPECT_NEAR(scene.cameras[0].far, 1.01f * std::sqrt(11.0f), 1e-5f);
}

TEST_F(SceneFile, PathsAreLinearBetweenKeys) {
    const Scene scene = load(
        R"({"gltf": "room.glb", "cameras": [{"name": "dolly", "vfov_deg": 50, "path": [{"frame": 0, "position": [0, 0, 4], "target": [0, 0, 0]}, {"frame": 10, "position": [0, 2, 4], "target": [0, 2, 0]}]}]})");
    EXPECT_EQ(scene.camera("dolly").frame_count, 11u);
    const CameraPose pose = pose_camera(scene.camera("dolly"), pose_scene(scene, 0), 5);
    EXPECT_NEAR(pose.world_from_view[3].y, 1.0f, 1e-6f);
    EXPECT_EQ(&scene.camera(""), &scene.cameras[0]);
    EXPECT_THROW(scene.camera("doly"), Error);
}

TEST_F(SceneFile, EnvironmentImagesAreFoundByTheSearchPath) {
    HostImage sky({8, 4}, 3, 2.0f);
    write_exr(root / "skies/sky.exr", sky);
    EXPECT_NEAR(load(R"({"gltf": "room.glb", "environment": {"image": "skies/sky.exr", "scale": 3}, )" + camera + "}")
                    .environment.radiance({1, 0, 0})
                    .x,
                6.0f, 1e-5f);
    sky.values[7] = -1.0f;
    write_exr(root / "skies/sky.exr", sky);
    EXPECT_NE(mistake(R"({"gltf": "room.glb", "environment": {"image": "skies/sky.exr"}, )" + camera + "}")
                  .find("must be finite and not negative"),
              std::string::npos);
}

TEST_F(SceneFile, MistakesNameFileAndKey) {
    EXPECT_NE(mistake(R"({"gltf": "room.glb", "enviroment": {}, )" + camera + "}").find("did you mean 'environment'?"),
              std::string::npos);
    EXPECT_NE(mistake(R"({"gltf": "rom.glb", )" + camera + "}").find("'rom.glb' is neither beside that file"),
              std::string::npos);
    EXPECT_NE(mistake(R"({"gltf": "room.glb"})").find("no camera"), std::string::npos);
    EXPECT_NE(mistake(R"({"gltf": "room.glb", "overrides": [{"material": "roof"}], )" + camera + "}")
                  .find("no material's whole name matches \"roof\""),
              std::string::npos);
    EXPECT_NE(mistake(R"({"gltf": "room.glb", "overrides": [{"material": "floor", "roughness": 2}], )" + camera + "}")
                  .find("outside [0, 1]"),
              std::string::npos);
    EXPECT_NE(mistake("{\"gltf\": \"room.glb\",,}").find("scene.json:1:"), std::string::npos);
}

TEST_F(SceneFile, HashesWhatLightDependsOn) {
    const std::string plain = load(R"({"gltf": "room.glb", )" + camera + "}").content_hash;
    EXPECT_EQ(
        load(
            R"({"gltf": "room.glb", "cameras": [{"name": "other", "position": [0, 1, 3], "target": [0, 0, 0], "vfov_deg": 30}]})")
            .content_hash,
        plain);
    EXPECT_NE(load(R"({"gltf": "room.glb", "overrides": [{"material": "floor", "roughness": 0.2}], )" + camera + "}")
                  .content_hash,
              plain);
    EXPECT_NE(load(R"({"gltf": "room.glb", "environment": {"constant": [1, 1, 1]}, )" + camera + "}").content_hash,
              plain);
}

/// glTF 2.0, section 3.9.5: what is not double-sided is not seen from behind, unless the scene says otherwise.
TEST_F(SceneFile, HidesBacksUnlessItSaysThatTheyAreDrawn) {
    const auto scene = [&](const std::string& keys) { return load(R"({"gltf": "room.glb", )" + keys + camera + "}"); };
    const Scene plain = scene(""), culled = scene(R"("back_faces": "culled", )"),
                drawn = scene(R"("back_faces": "drawn", )");
    EXPECT_FALSE(plain.draws_backs);
    EXPECT_TRUE(plain.hides_backs());
    EXPECT_TRUE(drawn.draws_backs);
    EXPECT_EQ(plain.content_hash, culled.content_hash);
    EXPECT_NE(plain.content_hash, drawn.content_hash);
    EXPECT_FALSE(load_scene((root / "room/room.glb").string(), {}).draws_backs);
    EXPECT_NE(mistake(R"({"gltf": "room.glb", "back_faces": "shown", )" + camera + "}").find("'back_faces'"),
              std::string::npos);
    // Where all that is drawn is double-sided the key changes nothing.
    GltfWriter writer;
    writer.json["materials"] = {{{"name", "sheet"}, {"doubleSided", true}}};
    nlohmann::json quad = writer.quad();
    quad["material"] = 0;
    writer.add_mesh_node(quad);
    writer.write_glb(root / "room/room.glb");
    EXPECT_EQ(scene("").content_hash, scene(R"("back_faces": "drawn", )").content_hash);
}

TEST_F(SceneFile, PlanesOfTheSceneReplaceThoseOfTheGltf) {
    GltfWriter writer;
    writer.add_mesh_node(writer.quad());
    writer.json["scenes"][0]["nodes"] = {0, 1, 2};
    writer.json["nodes"].push_back({{"camera", 0}, {"translation", {0, 0, 3}}});
    writer.json["nodes"].push_back({{"camera", 1}, {"translation", {0, 0, 3}}});
    writer.json["cameras"] = {{{"name", "lens"},
                               {"type", "perspective"},
                               {"perspective", {{"yfov", 0.8}, {"aspectRatio", 1.5}, {"znear", 4}, {"zfar", 5}}}},
                              {{"name", "flat"},
                               {"type", "orthographic"},
                               {"orthographic", {{"xmag", -3}, {"ymag", 1.5}, {"znear", 4}, {"zfar", 5}}}}};
    writer.write_glb(root / "room/room.glb");
    const Scene scene = load(R"({"gltf": "room.glb", "cameras": [{"gltf": "lens"}, {"gltf": "flat", "planes": "scene"},
        {"gltf": "lens", "name": "out", "planes": "scene"},
        {"name": "own", "position": [0, 0, 3], "target": [0, 0, 0], "vfov_deg": 60, "planes": "scene"}]})");
    EXPECT_EQ(scene.camera("lens").near, 4);
    EXPECT_EQ(scene.camera("lens").aspect, 1.5f);
    EXPECT_EQ(scene.camera("flat").near, 0);
    EXPECT_EQ(scene.camera("flat").aspect, 2);  // xmag / ymag, whose signs mirror (3.10.3.4: SHOULD NOT be negative)
    // Half of the depth that the nearest point, 3 m away, has in the corner of the frame, in pictures from 2:1 to 1:2.
    const float edge = 1.5f * std::tan(0.4f);
    EXPECT_NEAR(scene.camera("out").near, 1.5f / std::sqrt(1 + 5 * edge * edge), 1e-5f);
    for (const char* name : {"out", "flat", "own"})
        EXPECT_NEAR(scene.camera(name).far, 1.01f * std::sqrt(11.0f), 1e-5f) << name;
    EXPECT_NE(mistake(R"({"gltf": "room.glb", "cameras": [{"name": "own", "position": [0, 0, 3], "target": [0, 0, 0],
        "vfov_deg": 60, "planes": "scene", "near": 1}]})")
                  .find("leave one of them out"),
              std::string::npos);
    EXPECT_NE(mistake(R"({"gltf": "room.glb", "cameras": [{"gltf": "lens", "planes": "file"}]})").find("'planes'"),
              std::string::npos);
}

TEST(Scenes, AllOfOursLoadWithoutWarning) {
    const fs::path ours = fs::path(SSRLAB_SOURCE_DIR) / "scenes";
    size_t loaded = 0;
    for (const std::string& name : list_scenes({ours})) {
        if (!fs::exists(ours / name / "scene.glb") && name != "sky_only") continue;  // third-party files, not here
        const Scene scene = load_scene(name, {ours});
        EXPECT_TRUE(scene.warnings.empty()) << name << ": " << scene.warnings.front().text;
        ++loaded;
    }
    EXPECT_GE(loaded, 10u);
}

TEST_F(SceneFile, FurtherFilesAreMergedAndWarningsOfTheHiddenDropped) {
    GltfWriter writer;
    writer.json["materials"] = {
        {{"name", "water"}, {"alphaMode", "BLEND"}, {"pbrMetallicRoughness", {{"baseColorFactor", {1, 1, 1, 0.25}}}}}};
    nlohmann::json quad = writer.quad();
    quad["material"] = 0;
    writer.add_mesh_node(quad);
    writer.json["nodes"][0]["translation"] = {0, 0, -5};
    writer.write_glb(root / "room/stage.glb");
    const std::string both = R"({"gltf": "room.glb", "also": ["stage.glb"], )";
    const Scene scene = load(both + camera + "}");
    ASSERT_EQ(scene.instances.size(), 3u);
    EXPECT_EQ(scene.materials[scene.meshes[scene.instances[2].mesh].material].name, "water");
    EXPECT_EQ(pose_scene(scene, 0).world_from_instance[2][3].z, -5.0f);
    EXPECT_EQ(scene.warnings.size(), 1u);
    const Scene dry = load(both + R"("overrides": [{"material": "water", "hidden": true}], )" + camera + "}");
    EXPECT_EQ(dry.instances.size(), 2u);
    EXPECT_TRUE(dry.warnings.empty());
    EXPECT_NE(dry.content_hash, scene.content_hash);
}

TEST_F(SceneFile, UnknownScenesAndBareFiles) {
    load(R"({"gltf": "room.glb", )" + camera + "}");
    EXPECT_EQ(error_message([&] { load_scene("rom", {root}); }), "unknown scene 'rom'; did you mean 'room'?");
    const Scene bare = load_scene((root / "room/room.glb").string(), {});
    EXPECT_EQ(bare.environment.color, glm::vec3(1));
    const CameraPose pose = pose_camera(bare.cameras.at(0), pose_scene(bare, 0), 0);
    for (const glm::uvec2 extent : {glm::uvec2(100, 100), {300, 100}, {40, 400}}) {
        const CameraData data = camera_data(pose, nullptr, {.extent = extent});
        for (const Vertex& v : bare.meshes[0].vertices) {  // the default camera sees all of it
            const glm::vec4 clip = data.clip_from_world * glm::vec4(v.position, 1);
            EXPECT_LT(std::max({std::abs(clip.x), std::abs(clip.y), clip.z}), clip.w);
            EXPECT_GT(clip.z, 0.0f);
        }
    }
}

TEST_F(SceneFile, EndingsAreOfAnyCaseAndNamesOfAnyLetters) {
    const std::string whole = R"({"gltf": "room.glb", )" + camera + "}";
    const std::string hash = load(whole).content_hash;
    const fs::path folder = root / "take#2 (a.b.c)";
    fs::create_directories(folder);
    for (const char* name : {"MODEL.GLB", "Model.Gltf", "v1.2.GLB", "x#y.glb"}) {
        fs::copy(root / "room/room.glb", folder / name);
        EXPECT_EQ(load_scene((folder / name).string(), {}).triangle_count(), 4u) << name;
    }
    fs::copy(root / "room/room.glb", folder / "room.glb");
    write_text(folder / "Scene.JSON", whole);
    EXPECT_EQ(load_scene((folder / "Scene.JSON").string(), {}).content_hash, hash);
    for (const char* name : {"street_42", "a.b.c", "Lamp_v1.2", "chair.glb", "take#3 x"}) {
        fs::copy(root / "room", root / name);
        EXPECT_EQ(load_scene(name, {root}).name, name);
        EXPECT_EQ(load_scene((root / name).string(), {}).name, name);  // by its path
    }
    const auto said = [&](const std::string& name) { return error_message([&] { load_scene(name, {root}); }); };
    write_text(root / "model.obj", "v 0 0 0");
    EXPECT_NE(said((root / "model.obj").string()).find("model.obj is no scene: scenes end in .json, .gltf or .glb"),
              std::string::npos);
    fs::create_directories(root / "empty");
    EXPECT_NE(said((root / "empty").string()).find("is a folder without a scene.json"), std::string::npos);
    EXPECT_NE(said("missing.GLB").find("missing.GLB: no such file"), std::string::npos);
}

TEST_F(SceneFile, CamerasOfOneNameInSeveralFilesAreToldApart) {
    for (const char* file : {"a.glb", "b.glb", "c.glb"}) {
        GltfWriter writer;
        writer.add_mesh_node(writer.quad());
        writer.json["cameras"] = {
            {{"name", "main"}, {"type", "perspective"}, {"perspective", {{"yfov", 1}, {"znear", 1}}}}};
        writer.json["nodes"][0]["camera"] = 0;
        writer.write_glb(root / "room" / file);
    }
    const Scene scene = load(R"({"gltf": "a.glb", "also": ["b.glb", "c.glb"]})");
    std::vector<std::string> names;
    for (const SceneCamera& c : scene.cameras) names.push_back(c.name);
    EXPECT_EQ(names, (std::vector<std::string>{"main", "main_2", "main_3"}));
    EXPECT_NE(scene.cameras[0].node, scene.cameras[1].node);
    const std::string twice = R"({"name": "m", "position": [0, 0, 3], "target": [0, 0, 0], "vfov_deg": 60})";
    EXPECT_NE(mistake(R"({"gltf": "a.glb", "cameras": [)" + twice + ", " + twice + "]}").find("two cameras named 'm'"),
              std::string::npos);
}

TEST_F(SceneFile, NumbersThatOverflowAreRefusedByKey) {
    const auto refuses = [&](const std::string& json, const std::string& what) {
        const std::string said = mistake(R"({"gltf": "room.glb", )" + json + "}");
        EXPECT_EQ(said.find((root / "room").string()), 0u) << said;
        EXPECT_NE(said.find(what), std::string::npos) << json << "\n" << said;
    };
    const auto with_camera = [](const std::string& json) { return json + ", " + camera; };
    refuses(with_camera(R"("environment": {"gradient": {"color": [1, 1, 1], "slope": [3e38, 0, 0]}})"), "'slope'");
    refuses(with_camera(R"("environment": {"gradient": {"color": [-2e38, 1, 1], "slope": [0, 0, 0]}})"), "'color'");
    refuses(with_camera(R"("environment": {"constant": [1e400, 0, 0]})"), "constant[0]: the number 1e400");
    refuses(with_camera(R"("environment": {"constant": [1e38, 0, 0]})"), "'constant'");
    refuses(with_camera(
                R"("lights": [{"type": "point", "position": [0, 1, 0], "color": [1e11, 1, 1], "intensity": 1e11}])"),
            "lights[0]: the product of 'color' and strength");
    refuses(with_camera(R"("lights": [{"type": "point", "position": [0, 1e20, 0], "intensity": 1}])"), "'position'");
    refuses(with_camera(R"("overrides": [{"material": "floor", "emission": [1e13, 0, 0]}])"), "'emission'");
    refuses(R"("cameras": [{"name": "m", "position": [0, 0, 3e38], "target": [0, 0, 0], "vfov_deg": 60}])",
            "'position'");
    // Squares of the direction's length overflow, or vanish, but the direction itself is clear.
    for (const char* axis : {"[0, 3e38, 0]", "[0, 1e-40, 0]"}) {
        const Scene scene = load(R"({"gltf": "room.glb", "environment": {"gradient": {"color": [1, 1, 1],
            "slope": [0.5, 0.5, 0.5], "axis": )" +
                                 std::string(axis) + "}}, " + camera + "}");
        EXPECT_EQ(scene.environment.axis, glm::vec3(0, 1, 0));
    }
    HostImage sky({8, 4}, 3, 1e20f);
    write_exr(root / "room/sky.exr", sky);
    refuses(with_camera(R"("environment": {"image": "sky.exr", "scale": 10})"), "sky.exr: an environment must be");
    EXPECT_EQ(mistake(R"({"gltf": "room.glb", "environment": {"constant": [1, 2, 3], "constant": [0, 0, 0]}, )" +
                      camera + "}"),
              (root / "room/scene.json").string() + ": environment: the key 'constant' comes twice in one object");
}

TEST_F(SceneFile, OverridesMatchInLinearTime) {
    GltfWriter writer;
    writer.json["materials"] = {{{"name", std::string(300'000, 'm')}}};
    nlohmann::json quad = writer.quad();
    quad["material"] = 0;
    writer.add_mesh_node(quad);
    writer.write_glb(root / "room/room.glb");
    const auto overridden = [&](const std::string& material) {
        return R"({"gltf": "room.glb", "overrides": [{"material": ")" + material + R"(", "roughness": 0.5}], )" +
               camera + "}";
    };
    EXPECT_EQ(load(overridden("(m*)*")).materials.at(0).roughness, 0.5f);
    EXPECT_NE(mistake(overridden("(m*)*b")).find("no material's whole name matches"), std::string::npos);
    EXPECT_NE(mistake(overridden(std::string(300'000, '('))).find("is no regular expression of RE2"),
              std::string::npos);
    EXPECT_NE(mistake(overridden("(m)\\\\1*")).find("is no regular expression of RE2"), std::string::npos);
}

TEST_F(SceneFile, FilesItNamesStayBelowItsFolder) {
    fs::copy(root / "room/room.glb", root / "other.glb");
    HostImage sky({1, 1}, 3, 1.0f);
    write_exr(root / "sky.exr", sky);
    for (const std::string& name : {std::string("../other.glb"), (root / "other.glb").string()}) {
        const std::string scene = R"({"gltf": ")" + name + R"(", )" + camera + "}";
        EXPECT_NE(mistake(scene).find("is not below the folder of the file that names it"), std::string::npos);
        const LimitsOf limits({.memory = reading_limits().memory, .allows_outside = true});
        EXPECT_EQ(load(scene).triangle_count(), 4u);
    }
    EXPECT_NE(mistake(R"({"environment": {"image": "../sky.exr"}, )" + camera + "}").find("'../sky.exr' is not below"),
              std::string::npos);
    EXPECT_NE(mistake(R"({"also": ["../other.glb"], )" + camera + "}").find("is not below"), std::string::npos);
    EXPECT_EQ(load(R"({"gltf": "other.glb", )" + camera + "}").triangle_count(), 4u);  // by the search path
}
