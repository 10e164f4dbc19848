// Reflection probes: what reflections fall back to in rooms.
#include "experiments/study/measuring/reflection_probe.h"
#include "core/error.h"
#include "core/scene/load_scene.h"
#include "tests/error_message.h"
#include "tests/experiments/study/study_fixture.h"

#include <random>
#include <set>

/// A sky without a mirror plane: any two axes that were exchanged or turned would show.
TEST(ReflectionProbes, OfASkyAreThatSky) {
    Scene sky = load_scene("sky_only", {std::filesystem::path(SSRLAB_SOURCE_DIR) / "scenes"});
    sky.environment = {.type = Environment::Type::gradient,
                       .color = glm::vec3(2, 3, 4),
                       .slope = glm::vec3(1.0f, -2.0f, 3.5f),
                       .axis = glm::normalize(glm::vec3(0.3f, 0.5f, -0.8f))};
    sky.content_hash = "sky without a mirror plane";
    const ScenePose pose = pose_scene(sky, 0);
    unsigned views = 0;
    const Environment probe = reflection_probe(
        {1, 2, 3}, {}, [&](const CameraPose& camera, glm::uvec2 extent, const ReferenceSettings& settings) {
            ++views;
            return render_reference(sky, pose, camera, extent, settings);
        });
    EXPECT_EQ(views, 6u);
    std::mt19937 random(3);
    std::normal_distribution<float> normal;
    for (int i = 0; i < 2000; ++i) {
        const glm::vec3 d = glm::normalize(glm::vec3(normal(random), normal(random), normal(random)));
        const glm::vec3 found = probe.radiance(d), sought = sky.environment.radiance(d);
        // A texel is 0.05 wide: interpolated within it, and at the edges of faces held for half of one.
        for (int c = 0; c < 3; ++c) ASSERT_NEAR(found[c], sought[c], 0.05f * 3.5f) << d.x << " " << d.y << " " << d.z;
    }
}

/// Studies whose references have other seeds read the same probe, and no reference draws the samples of its probe.
TEST(ReflectionProbes, AreTheSameForAllReferencesAndIndependentOfThem) {
    const auto seeds_of_views = [](unsigned reference_seed) {
        std::vector<unsigned> seeds;
        reflection_probe({}, {.seed = reference_seed},
                         [&](const CameraPose&, glm::uvec2 extent, const ReferenceSettings& of_view) {
                             seeds.push_back(of_view.seed);
                             Reference black;
                             black.image.mean = HostImage(extent, 3);
                             return black;
                         });
        return seeds;
    };
    const std::vector<unsigned> usual = seeds_of_views(ReferenceSettings().seed);
    EXPECT_EQ(std::set(usual.begin(), usual.end()).size(), 6u) << "nor do two views draw the same";
    for (const unsigned seed : {0u, 1u, 0x9706eu, 1u << 30, usual.front() - 1, usual.back() + 1})
        EXPECT_EQ(seeds_of_views(seed), usual) << seed;
    for (const unsigned seed : usual)
        EXPECT_EQ(std::ranges::count(seeds_of_views(seed), seed), 0) << "a reference of the probe's own seed " << seed;
}

TEST_F(StudyTest, ReflectionsFallBackToAProbeWhereAsked) {
    write_text(folder / "study.json",
               R"({"shots": [{"scene": "dark_room", "resolution": [48, 27]}], "fallback": ["environment", "probe"],
        "techniques": [{"technique": "none"}], "metrics": "mse", "targets": "specular", "masks": "reflective",
        "reference": {"samples": 64}, "timing": {"frames": 0}})");
    std::map<bool, double> errors;
    for (const ResultRow& r : read_rows<ResultRow>(run(read_config(folder / "study.json"), "out") / "results.csv"))
        errors[r.shot.ends_with(".probe")] = *r.value;
    ASSERT_EQ(errors.size(), 2u);
    EXPECT_LT(errors[true], 0.5 * errors[false]) << "of a dark room whose one window shows a bright sky";
    // Both shots have the same references: the probe alone distinguishes their cells, so that none of other pixels is
    // merged.
    std::set<std::string> truths;
    for (const auto& file : fs::directory_iterator(folder / "out" / "cells"))
        truths.insert(nlohmann::json::parse(read_text(file.path()))["cell"]["truth"].get<std::string>());
    EXPECT_EQ(truths.size(), 2u);
    const auto refused = [&](const std::string& more) {
        write_text(
            folder / "study.json",
            R"({"shots": [{"scene": "dark_room", "fallback": "probe"}], "techniques": [{"technique": "none"}], )" +
                more + "}");
        return error_message([&] { read_config(folder / "study.json"); });
    };
    EXPECT_NE(refused(R"("targets": ["specular", "on_screen"])").find("fall back to the environment"),
              std::string::npos);
    fs::create_directories(folder / "capture" / "frame_0");
    write_text(folder / "study.json",
               R"({"shots": [{"gbuffer": "capture", "fallback": "probe"}], "techniques": [{"technique": "none"}]})");
    EXPECT_NE(error_message([&] { read_config(folder / "study.json"); }).find("needs a scene"), std::string::npos);
    EXPECT_NE(refused(R"("lit": "direct")").find("needs path-traced light"), std::string::npos);
}
