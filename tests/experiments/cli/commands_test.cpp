// What commands of `ssrlab` print and write when all is well.
#include "core/exr/exr.h"
#include "core/json.h"
#include "core/png.h"
#include "tests/experiments/cli/command_line_fixture.h"

#include <regex>

/// A glTF as another program writes one: a blended triangle of 2 m.
constexpr const char* blended_triangle = R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
    "nodes": [{"mesh": 0}], "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0}]}],
    "materials": [{"name": "glass", "alphaMode": "BLEND", "pbrMetallicRoughness": {"baseColorFactor": [1, 1, 1, 0.6]}}], "bufferViews": [{"buffer": 0, "byteLength": 36}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "type": "VEC3", "count": 3, "min": [-1, -1, 0], "max": [1, 1, 0]}],
    "buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64,AACAvwAAgL8AAAAAAACAPwAAgL8AAAAAAAAAAAAAgD8AAAAA"}]})";

TEST_F(CommandLine, ComparesByOneNumberPerLine) {
    write_exr(folder / "a.exr", HostImage({16, 16}, 3, 0.5f));
    write_exr(folder / "b.exr", HostImage({16, 16}, 3, 0.75f));
    const Outcome o = ssrlab("compare a.exr b.exr --metric mse --metric mae");
    EXPECT_EQ(o.code, 0);
    EXPECT_EQ(o.text, "mse 0.0625\nmae 0.25\n");
    EXPECT_EQ(ssrlab("compare a.exr b.exr --metric mse --json --map m.exr").code, 0);
    EXPECT_NEAR(read_exr_rgb(folder / "m.exr").values[0], 0.0625f, 1e-7f);
}

TEST_F(CommandLine, ComparesVisibility) {
    for (const char* name : {"r_0.exr", "r_1.exr"}) write_exr(folder / name, HostImage({16, 16}, 3, 0.5f));
    for (const char* name : {"t_0.exr", "t_1.exr"}) {
        HostImage image({16, 16}, 3, 0.5f);
        image.set_rgb(100, {1, 1, 1});
        write_exr(folder / name, image);
    }
    const Outcome still = ssrlab("compare r_0.exr t_0.exr --metric cvvdp_0_5_6 --nits-per-unit 100");
    EXPECT_EQ(still.code, 0);
    EXPECT_TRUE(std::regex_match(still.text, std::regex(R"(cvvdp_0_5_6 [0-9.]+ \(standard_hdr_linear, 100 nits per )"
                                                        R"(unit, 75\.4024 pixels per degree, version 0\.5\.6\)\n)")))
        << still.text;
    const Outcome video =
        ssrlab("compare r_#.exr t_#.exr --metric cvvdp_0_5_6 --display standard_fhd --fps 30 --padding symmetric");
    EXPECT_EQ(video.code, 0);
    EXPECT_TRUE(std::regex_match(
        video.text,
        std::regex(
            R"(cvvdp_0_5_6 [0-9.]+ \(standard_fhd, exposure 0 EV, tone map none, 37\.8425 pixels per degree, 30 )"
            R"(frames per second, padding symmetric, 2 frames pooled, version )"
            R"(0\.5\.6\)\n)")))
        << video.text;
    EXPECT_EQ(ssrlab("compare r_0.exr r_0.exr --metric cvvdp_0_5_6").text.substr(0, 15), "cvvdp_0_5_6 10 ");

    const std::string as_video = "compare r_#.exr t_#.exr --metric cvvdp_0_5_6";
    expect_mistake(as_video, "give --fps");
    for (const std::string rate : {"0", "1000"}) {
        const Outcome refused = ssrlab(as_video + " --fps " + rate);
        EXPECT_EQ(refused.code, 2);
        EXPECT_NE(refused.text.find("--fps: '" + rate + "' must be a number from 1 to 240"), std::string::npos);
    }
    expect_mistake(as_video + " --fps 30 --padding warm_up", "need 9 frames");
    expect_mistake("compare r_#.exr t_0.exr --metric cvvdp_0_5_6 --fps 30", "give two of one kind");
    expect_mistake("compare r_0.exr t_0.exr --metric cvvdp_0_5_6 --fps 30", "for videos");
    expect_mistake("compare r_0.exr t_0.exr --metric mse --display standard_4k", "add --metric cvvdp_0_5_6");
    expect_mistake("compare r_0.exr t_0.exr --metric cvvdp_0_5_6 --display standard_4", "did you mean 'standard_4k'?");
    expect_mistake("compare x_#.exr t_#.exr --metric cvvdp_0_5_6 --fps 30", "no file has a name of this pattern");
}

TEST_F(CommandLine, ComparesLayersOfReferences) {
    const std::string small = "reference roughness_gradient --size 16 9 --samples ";
    const Outcome few = ssrlab(small + "16 --out few.exr");
    EXPECT_TRUE(std::regex_search(few.text, std::regex(" s, 2[0-9]{3} rays\n"))) << few.text;  // not 2.6e-06 Gray
    EXPECT_EQ(ssrlab(small + "64 --out more.exr").code, 0);
    const Outcome image = ssrlab("compare more.exr few.exr --metric mse"),
                  named = ssrlab("compare more.exr few.exr --metric mse --layer image"),
                  specular = ssrlab("compare more.exr few.exr --metric mse --layer specular");
    EXPECT_EQ(image.code, 0) << image.text;
    EXPECT_EQ(image.text, named.text);
    EXPECT_EQ(specular.code, 0) << specular.text;
    EXPECT_NE(specular.text, image.text);
    expect_mistake("compare more.exr few.exr --layer speculr",
                   "more.exr has no layer 'speculr'; did you mean 'specular'?");
}

/// Frames of a renderer that are the truth itself, and some that are dimmer.
TEST_F(CommandLine, JudgesFrames) {
    ASSERT_EQ(ssrlab("reference mirror_pillars --size 48 27 --samples 64 --out truth.exr").code, 0);
    const HostImage image = read_exr_rgb(folder / "truth.exr", "image"),
                    specular = read_exr_rgb(folder / "truth.exr", "specular");
    for (const auto& [name, share] : {std::pair("now", 0.7f), std::pair("before", 0.8f)}) {
        HostImage off = image, frame = image;
        for (size_t i = 0; i < image.values.size(); ++i) {
            off.values[i] -= specular.values[i];
            frame.values[i] = off.values[i] + share * specular.values[i];
        }
        const fs::path view = folder / name / "mirror_pillars.main.48x27";
        write_exr(view / "f0.s0.exr", frame), write_exr(view / "f0.off.exr", off);
        write_text(folder / name / "external.json", R"({"name": "dim", "engine": "a renderer", "version": "1"})");
    }
    const Outcome worse = ssrlab("judge now --against before --samples 64 --fail-if-worse");
    EXPECT_EQ(worse.code, 1);
    EXPECT_NE(worse.text.find("\nworse against before: error in mirror_pillars.main.48x27\n"), std::string::npos)
        << worse.text;
    EXPECT_TRUE(fs::exists(folder / "results/judge/report.html"));
    // Shares of 0.7 and 0.8 err by 0.09 and 0.04: 2.25 times.
    EXPECT_EQ(ssrlab("judge now --against before --samples 64 --fail-if-worse --worse-by 2.2").code, 1);
    EXPECT_EQ(ssrlab("judge now --against before --samples 64 --fail-if-worse --worse-by 2.3").code, 0);
    for (const char* ratio : {"0.99", "nan", "inf", "five", "-1"}) {
        const Outcome refused = ssrlab("judge now --against before --worse-by " + std::string(ratio));
        EXPECT_EQ(refused.code, 2) << ratio;
        EXPECT_TRUE(refused.text.starts_with("error: --worse-by: '" + std::string(ratio) +
                                             "' must be a ratio of errors from 1 to 1000, for example 1.05; see"))
            << refused.text;
    }
    expect_mistake("judge now --worse-by 1.05", "--worse-by needs --against");
    EXPECT_EQ(ssrlab("judge now --against before --samples 64").code, 0);
    const Outcome better = ssrlab("judge before --against now --samples 64 --fail-if-worse");
    EXPECT_EQ(better.code, 0);
    EXPECT_NE(better.text.find("\nbetter against now: error in mirror_pillars.main.48x27\n"), std::string::npos)
        << better.text;
    // A captured G-buffer with its truth in place of the scene.
    ASSERT_EQ(ssrlab("gbuffer mirror_pillars --size 48 27 --out cap").code, 0);
    fs::rename(folder / "now/mirror_pillars.main.48x27", folder / "now/cap.gbuffer.48x27");
    const Outcome captured = ssrlab("judge now --capture cap --reference truth.exr");
    EXPECT_EQ(captured.code, 0) << captured.text;
    EXPECT_NE(captured.text.find("\ncap.gbuffer.48x27: mse "), std::string::npos) << captured.text;
    const Outcome inspected = ssrlab("inspect now");
    EXPECT_EQ(inspected.code, 0) << inspected.text;
    EXPECT_NE(inspected.text.find("cap"), std::string::npos) << inspected.text;
    expect_mistake("judge now", "judge them with `--capture cap --reference FILE.exr`");
    expect_mistake("judge nowhere", "nowhere holds no external.json");
    expect_mistake("judge now --fail-if-worse", "--fail-if-worse needs --against");
    expect_mistake("judge now --capture before", "--capture needs --reference");
    expect_mistake("judge now --scene fence", "now holds no images of 'fence'");
    expect_mistake("judge before --out truth.exr", "truth.exr is a file and no folder");
    // What has another form than the command takes.
    write_text(folder / "mine/technique.json", "{}");
    expect_mistake("describe mine", "for the folder of this name write ./mine");
    expect_mistake("compare now before --metric mse", "now is a folder. Give an image, or the frames of a video");
    expect_mistake("compare truth.exr truth.exr --metric cvvdp_0_5_6_video", "scores two videos by cvvdp_0_5_6");
    expect_mistake("advise --chip 'RX 480'", "it has gfx1100 (Radeon RX 7900 XTX)");
    EXPECT_EQ(ssrlab("advise --chip 'rx 6800xt' --ms 1").text, ssrlab("advise --chip navi21 --ms 1").text);
}

TEST_F(CommandLine, WritesScenesForEngines) {
    const Outcome o =
        ssrlab("scene-for three mirror_pillars --size 32 18 --samples 16 --camera main dolly --frames 0-1 5 --out s");
    EXPECT_EQ(o.code, 0) << o.text;
    EXPECT_NE(o.text.find("s/scene.json: 2 views, 6 light images (3 from the cache)"), std::string::npos)
        << "main stands still, and dolly starts there\n"
        << o.text;
    for (const char* file : {"scene.glb", "scene.json", "mirror_pillars.main.32x18/f1.light.exr",
                             "mirror_pillars.dolly.32x18/f5.depth.exr"})
        EXPECT_TRUE(fs::exists(folder / "s" / file)) << file;
    expect_mistake("scene-for thre mirror_pillars --out s", "unknown engine 'thre'; did you mean 'three'?");
    expect_mistake("scene-for any mirror_pillars --frames 5-1 --out s", "--frames: '5-1' ends before it begins");
    expect_mistake("scene-for any mirror_pillars --frames 1e3 --out s", "--frames: '1e3' must be a frame");
    expect_mistake("scene-for any mirror_pillars --frames 0-9999 10000 --out s",
                   "10001 frames are more than the 10000 that a folder holds");
    expect_mistake("scene-for any mirror_pillars --camera bak --out s", "'bak'");
    EXPECT_EQ(ssrlab("scene-for any mirror_pillars").code, 2) << "without --out";
}

TEST_F(CommandLine, InspectsFilesOfAnybody) {
    write_text(folder / "glass.gltf", blended_triangle);
    const Outcome page = ssrlab("inspect glass.gltf");
    EXPECT_EQ(page.code, 0) << page.text;
    EXPECT_NE(page.text.find("2 x 2 x 0 m"), std::string::npos) << page.text;
    EXPECT_NE(page.text.find("'glass' is blended (alphaMode BLEND)"), std::string::npos) << page.text;
    EXPECT_LE(std::ranges::count(page.text, '\n'), 60);
    const Outcome as_json = ssrlab("inspect glass.gltf --json - --picture view.png");
    const nlohmann::json json = nlohmann::json::parse(as_json.text, nullptr, false);
    ASSERT_TRUE(json.is_object()) << as_json.text;
    EXPECT_EQ(json["triangles"], 1);
    EXPECT_GT(json["warnings"][0]["share_of_first_view"], 0.05);
    EXPECT_EQ(json["first_view"]["differ"], 0);
    EXPECT_TRUE(fs::exists(folder / "view.png"));

    write_exr(folder / "a.exr", HostImage({16, 16}, 3, 0.5f));
    EXPECT_EQ(ssrlab("inspect a.exr").code, 0);
    expect_mistake("inspect a.exr --picture b.png", "a.exr is no scene");
    expect_mistake("inspect no_such", "unknown scene 'no_such'");
    expect_mistake("inspect .", "holds none of scene.json");
    fs::resize_file(folder / "a.exr", 100);
    const Outcome broken = ssrlab("inspect a.exr"), compared = ssrlab("compare a.exr a.exr");
    EXPECT_EQ(broken.code, 2);
    EXPECT_EQ(broken.text.find("`ssrlab inspect"), std::string::npos) << broken.text;
    EXPECT_EQ(compared.code, 2);
    EXPECT_NE(compared.text.find("\nnote: `ssrlab inspect a.exr` shows"), std::string::npos) << compared.text;
    EXPECT_FALSE(fs::exists(folder / "b.png"));
}

TEST_F(CommandLine, EveryCommandExplainsItself) {
    for (const char* command : {"", "run", "figures", "compare", "judge", "scene-for", "reference", "gbuffer",
                                "inspect", "needs", "describe", "list"}) {
        const Outcome o = ssrlab(std::string(command) + " --help");
        EXPECT_EQ(o.code, 0);
        EXPECT_GT(o.text.size(), 100u) << command;
    }
    EXPECT_NE(ssrlab("describe mcguire_dda").text.find("dda.thickness"), std::string::npos);
    EXPECT_NE(ssrlab("describe diligent_ssr").text.find("Enforced limits: WebGL 2"), std::string::npos);
    EXPECT_EQ(ssrlab("describe amd_sssr").text.find("Enforced limits"), std::string::npos);
    EXPECT_NE(ssrlab("describe --schema").text.find("\"dda.max_steps\""), std::string::npos);
}

TEST_F(CommandLine, ListsWhatEachThingIs) {
    fs::create_directories(folder / "more/my_scene");
    write_text(folder / "more/my_scene/scene.json", "{}");
    const std::string scenes = ssrlab("list scenes --scene-path more").text;
    EXPECT_NE(scenes.find("\nfence   "), std::string::npos) << scenes;
    EXPECT_NE(scenes.find(" Poles of 2 cm"), std::string::npos) << scenes;
    EXPECT_NE(scenes.find("  Cameras: main, lateral\n"), std::string::npos) << scenes;
    EXPECT_NE(scenes.find("\nroom:0 to room:999999  "), std::string::npos) << scenes;
    EXPECT_NE(scenes.find("\nmy_scene\n"), std::string::npos) << "it has no about.txt\n" << scenes;
    const std::string techniques = ssrlab("list techniques").text;
    EXPECT_NE(techniques.find("none: No screen-space reflections\n    Confidence 0 everywhere"), std::string::npos)
        << techniques;
    EXPECT_NE(
        ssrlab("list presets").text.find("\namd_sssr:corrected\n    for the original's design without its defects"),
        std::string::npos);
}

TEST_F(CommandLine, SavesGBuffers) {
    const Outcome o = ssrlab("gbuffer fence --size 33 21 --out g --reversed-depth");
    EXPECT_EQ(o.code, 0) << o.text;
    EXPECT_EQ(read_exr(folder / "g/gbuffer.exr").find("depth")->image.extent, glm::uvec2(33, 21));
    EXPECT_TRUE(fs::exists(folder / "g/camera.json"));
    EXPECT_EQ(read_png_codes(folder / "g/gbuffer.png").extent, glm::uvec2(3 * (33 + 4) - 4, 3 * (21 + 4 + 14) - 4));
}

TEST_F(CommandLine, WritesReferencesAsPictures) {
    const Outcome o = ssrlab("reference fence --size 24 14 --samples 16 --out r.exr");
    EXPECT_EQ(o.code, 0) << o.text;
    EXPECT_NE(o.text.find("r.png"), std::string::npos) << o.text;
    const HostImage light = read_exr_rgb(folder / "r.exr"), picture = read_png_codes(folder / "r.png");
    ASSERT_EQ(picture.extent, light.extent);
    // All pixels have one exposure: that of the scene's camera, by a pixel that is neither black nor white.
    size_t middle = 0;
    const auto code = [&](size_t i) { return picture.values[i]; };
    while (middle < picture.values.size() && !(code(middle) > 0.4f && code(middle) < 0.6f)) ++middle;
    ASSERT_LT(middle, picture.values.size());
    const float gain = std::exp2(std::round(2 * std::log2(linear_from_srgb(code(middle)) / light.values[middle])) / 2);
    for (size_t i = 0; i < picture.values.size(); ++i)  // half a code of rounding, and the EXR's half floats
        ASSERT_NEAR(code(i), srgb_from_linear(std::clamp(light.values[i] * gain, 0.0f, 1.0f)), 0.6 / 255) << i;
    expect_mistake("reference fence --out r.png", "a reference is an EXR file");
}

TEST_F(CommandLine, TellsWarningsOfASceneOnce) {
    write_text(folder / "glass.gltf", blended_triangle);
    config(R"({"shots": [{"scene": "glass.gltf", "resolution": [[16, 16], [24, 24]]}], "reference": {"samples": 16},
               "techniques": [{"technique": "none"}], "timing": {"frames": 0}, "seeds": 1})");
    const auto warnings = [](const std::string& text) {
        size_t count = 0;
        for (size_t at = 0; (at = text.find("is blended (alphaMode BLEND)", at)) != std::string::npos; ++at) ++count;
        return count;
    };
    const Outcome references = ssrlab("run study.json --out o --cells references"),
                  rest = ssrlab("run study.json --out o");
    EXPECT_EQ(warnings(references.text), 1u) << references.text;
    EXPECT_NE(references.text.find("of the first view's pixels"), std::string::npos) << references.text;
    EXPECT_EQ(rest.code, 0) << rest.text;
    EXPECT_EQ(warnings(rest.text), 0u) << rest.text;
    EXPECT_EQ(warnings(read_text(folder / "o/manifest.json")), 2u) << "that of each shot";
}

TEST_F(CommandLine, ShowsWhatACompilerMakesOfATechnique) {
    const Outcome o = ssrlab("shaders mcguire_dda --chip navi21 --csv table.csv");
    if (o.text.find("there is no radv") != std::string::npos) GTEST_SKIP() << o.text;
    EXPECT_EQ(o.code, 0) << o.text;
    EXPECT_NE(o.text.find("mcguire_dda default on navi21 (radv Mesa "), std::string::npos) << o.text;
    EXPECT_TRUE(fs::exists(folder / "table.csv"));
}

/// A preset would name parameters that the author of the copy may remove.
TEST_F(CommandLine, CopiesATechniqueWithoutItsPresets) {
    for (const std::string from : {"mcguire_dda", "simple_ssr", "four_mode_ssr", "composed_ssr"}) {
        ASSERT_EQ(ssrlab("new my_" + from + " --from " + from).code, 0) << from;
        const fs::path copy = folder / ("my_" + from), origin = fs::path(SSRLAB_SOURCE_DIR) / "variants" / from;
        nlohmann::json expected = read_json(origin / "technique.json"), made = read_json(copy / "technique.json");
        ASSERT_FALSE(expected.at("presets").empty());
        EXPECT_EQ(made.at("presets"), nlohmann::json::array());
        for (const char* key : {"presets", "passes"}) expected.erase(key), made.erase(key);  // passes name other files
        EXPECT_EQ(made, expected) << from;
        EXPECT_FALSE(fs::exists(copy / "tuned_presets.json"));
    }
}
