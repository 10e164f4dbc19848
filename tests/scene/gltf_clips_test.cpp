// Which of a file's animations is played.
#include "core/scene/animation.h"
#include "tests/scene/gltf_fixture.h"

#include <fstream>

namespace {

/// A square that "rest" holds, that "run" moves, and a second one that "Action" moves.
struct Clips : Gltf {
    void SetUp() override {
        Gltf::SetUp();
        writer.add_mesh_node(writer.quad());
        writer.add_mesh_node(writer.quad());
        writer.json["scenes"][0]["nodes"] = {0, 1};
        writer.json["nodes"][0]["name"] = "hero";
        writer.json["animations"] = {clip("rest", 0, "translation", 0.0f), clip("run", 0, "translation", 8.0f)};
    }

    /// Moves or scales a node along x from 0 to `end` within a second, for rotations: by nothing.
    nlohmann::json clip(const std::string& name, int node, const std::string& path, float end, float seconds = 1.0f) {
        const int times = writer.floats({0, seconds}, "SCALAR");
        const int values = path == "rotation" ? writer.floats({0, 0, 0, 1, 0, 0, 0, 1}, "VEC4")
                                              : writer.floats({0, 0, 0, end, 0, 0}, "VEC3");
        return {{"name", name},
                {"samplers", {{{"input", times}, {"output", values}}}},
                {"channels", {{{"sampler", 0}, {"target", {{"node", node}, {"path", path}}}}}}};
    }
    Scene played(const std::string& animation) {
        return load_gltf(writer.write_glb(folder / "a.glb"), {.animation = animation});
    }
    /// Where the hero is after a second.
    float x(const Scene& scene, size_t instance = 0) {
        return pose_scene(scene, 30).world_from_instance.at(instance)[3].x;
    }
};

}  // namespace

TEST_F(Clips, TheFirstIsPlayedAndSaid) {
    Scene scene = load();
    EXPECT_EQ(x(scene), 0.0f) << "no mixture: run is not played";
    EXPECT_EQ(scene.animation.size(), 1u);
    EXPECT_TRUE(mentions(scene.warnings, "Animation 'rest' is played, the first of 2 ('rest', 'run')"));
    EXPECT_TRUE(mentions(scene.warnings, "--animation"));
    ASSERT_EQ(scene.clips.size(), 2u);
    EXPECT_TRUE(scene.clips[0].is_played);
    EXPECT_FALSE(scene.clips[1].is_played);
}

TEST_F(Clips, OneIsPlayedByItsName) {
    writer.json["animations"][1] = clip("run", 0, "translation", 8.0f, 2.0f);
    const Scene run = played("run"), none = played("none"), all = played("all");
    EXPECT_EQ(pose_scene(run, 60).world_from_instance[0][3].x, 8.0f);
    EXPECT_EQ(run.frame_count, 61u) << "the length of what is played";
    EXPECT_EQ(played("rest").frame_count, 31u);
    EXPECT_TRUE(run.warnings.empty()) << "who chose knows";
    EXPECT_TRUE(none.animation.empty());
    EXPECT_EQ(none.frame_count, 1u);
    EXPECT_TRUE(none.warnings.empty());
    EXPECT_EQ(all.animation.size(), 2u);
    EXPECT_EQ(pose_scene(all, 60).world_from_instance[0][3].x, 8.0f) << "the last one counts";
    EXPECT_NE(run.content_hash, none.content_hash);
}

TEST_F(Clips, NamesThatFilesLackOrRepeatAreMade) {
    writer.json["animations"][0].erase("name");
    writer.json["animations"].push_back(clip("run", 0, "translation", 4.0f));
    EXPECT_EQ(x(played("animation_0")), 0.0f);
    EXPECT_EQ(x(played("run")), 8.0f);
    EXPECT_EQ(x(played("run_2")), 4.0f);
    writer.json["animations"][0]["name"] = "none";
    EXPECT_EQ(played("none").animation.size(), 1u) << "a name of the file's is that";
}

TEST_F(Clips, OnesOfDifferentPropertiesArePartsOfOneMotion) {
    // As exporters write them that make one animation of each object, or of each property.
    writer.json["animations"] = {clip("Action", 0, "translation", 8.0f), clip("Action", 1, "translation", 2.0f),
                                 clip("Action", 0, "scale", 1.0f)};
    const Scene scene = load();
    EXPECT_EQ(scene.animation.size(), 3u);
    EXPECT_EQ(x(scene, 0), 8.0f);
    EXPECT_EQ(x(scene, 1), 2.0f);
    EXPECT_TRUE(mentions(scene.warnings, "All 3 animations ('Action', 'Action_2', 'Action_3') are played together"));
    EXPECT_EQ(played("Action_2").animation.size(), 1u);
    // Of what is not in the scene nothing can be seen to overlap.
    writer.json["scenes"][0]["nodes"] = {0};
    writer.json["animations"].push_back(clip("other", 1, "translation", 3.0f));
    EXPECT_EQ(load().animation.size(), 2u);
}

TEST_F(Clips, WhatNeedsNoWordsGetsNone) {
    writer.json["animations"].erase(1);
    EXPECT_TRUE(load().warnings.empty()) << "one clip";
    writer.json["animations"].clear();
    EXPECT_TRUE(load().warnings.empty()) << "no clip";
}

TEST_F(Clips, ScenesChooseThem) {
    writer.write_glb(folder / "a.glb");
    std::swap(writer.json["animations"][0], writer.json["animations"][1]);
    writer.json["animations"][1]["name"] = "walk";
    writer.write_glb(folder / "b.glb");
    const auto load_with = [&](const std::string& keys, const std::string& option = "") {
        std::ofstream(folder / "scene.json")
            << R"({"gltf": "a.glb", "cameras": [{"name": "c", "position": [0, 0, 5], "target": [0, 0, 0], "vfov_deg": 40}])"
            << keys << "}";
        return load_scene((folder / "scene.json").string(), {}, {.animation = option});
    };
    EXPECT_EQ(x(load_with("")), 0.0f);
    EXPECT_EQ(x(load_with(R"(, "animation": "run")")), 8.0f);
    EXPECT_EQ(x(load_with(R"(, "animation": "run")", "rest")), 0.0f) << "the command line comes first";
    EXPECT_TRUE(load_with(R"(, "animation": "none")").animation.empty());
    // A name is looked for in all files; those without it play what they would.
    const Scene both = load_with(R"(, "also": ["b.glb"], "animation": "walk")");
    EXPECT_EQ(x(both, 0), 0.0f);
    EXPECT_EQ(x(both, 2), 0.0f);
    EXPECT_EQ(x(load_with(R"(, "also": ["b.glb"], "animation": "run")"), 2), 8.0f);
    EXPECT_NE(error_message([&] {
                  load_with(R"(, "animation": "rum")");
              }).find("has no animation 'rum'; did you mean 'run'?"),
              std::string::npos);
    EXPECT_NE(error_message([&] {
                  load_scene((folder / "a.glb").string(), {}, {.animation = "fly"});
              }).find("has no animation 'fly'; known are: rest, run"),
              std::string::npos);
    writer.json["animations"].clear();
    writer.write_glb(folder / "a.glb");
    EXPECT_NE(error_message([&] { load_with(R"(, "animation": "run")"); }).find("there are none"), std::string::npos);
}

TEST_F(Clips, PointersMoveNodesAndNameWhatTheyDoNotMove) {
    writer.json["animations"].erase(0);
    auto& target = writer.json["animations"][0]["channels"][0]["target"];
    const auto point_at = [&](const std::string& pointer) {
        target = {{"path", "pointer"}, {"extensions", {{"KHR_animation_pointer", {{"pointer", pointer}}}}}};
        return load();
    };
    writer.json["extensionsUsed"] = {"KHR_animation_pointer"};
    EXPECT_EQ(x(point_at("/nodes/0/translation")), 8.0f);
    EXPECT_TRUE(load().warnings.empty());
    for (const std::string pointer : {"/materials/0/emissiveFactor", "/nodes/0/extensions/KHR_node_visibility/visible",
                                      "/nodes/x/translation", "/nodes/", "", "nodes"}) {
        const Scene scene = point_at(pointer);
        EXPECT_TRUE(scene.animation.empty());
        EXPECT_TRUE(pointer.empty() || mentions(scene.warnings, "moves " + pointer));
    }
    EXPECT_NE(error_message([&] { point_at("/nodes/7/translation"); }).find("node 7 does not exist"),
              std::string::npos);
}
