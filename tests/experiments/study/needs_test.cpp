#include "experiments/study/needs.h"
#include "core/error.h"
#include "experiments/study/config/points/all_points.h"
#include "tests/variants/technique_fixture.h"

#include <algorithm>

namespace {

const std::vector<std::filesystem::path> scenes = {std::filesystem::path(SSRLAB_SOURCE_DIR) / "scenes"};

/// A preset or more of each technique, with all that reads what scenes may lack.
std::vector<PointConfig> points() {
    std::vector<PointConfig> all;
    const auto add = [&](const std::string& technique, const std::string& preset,
                         const nlohmann::json& parameters = nlohmann::json::object()) {
        all.push_back(single_point(technique, preset, parameters));
    };
    add("mcguire_dda", "best");
    add("amd_sssr", "corrected");
    add("diligent_ssr", "corrected", {{"misses", "fallback"}, {"previous_frame", true}});
    add("frostbite_sssr", "best", {{"misses", "fallback"}});
    add("simple_ssr", "slides_blurred", {{"previous_frame", true}});
    add("four_mode_ssr", "corrected", {{"mode", "temporal"}, {"history_place", "motion_vectors"}});
    return all;
}

struct Needs : TechniqueTest {
    /// Names of the parts that each technique leaves out; fails where images differ by more than they say.
    std::set<std::string> left_out(const Shot& shot) {
        std::set<std::string> names;
        const Config config = timed_config(points(), 0);
        const std::unique_ptr<FrameSource> source = scene_source(device(), shot, config, false);
        for (const PointConfig& point : config.techniques) {
            const MeasuredSaving saving = compare_with_all_kept(*source, shot, point);
            EXPECT_TRUE(saving.is_as_said()) << point.technique << " differs by " << saving.largest_difference;
            for (const LeftOutBy& part : left_out_of(shot, {point}))
                if (part.who.starts_with(point.technique)) names.insert(full_name(part.part));
        }
        return names;
    }

    static Shot shot(const std::string& scene, const std::string& camera, std::vector<unsigned> frames) {
        return load_shot(
            {.scene = scene, .camera = camera, .extent = {48, 27}, .frames = std::move(frames), .direct_lit = true},
            scenes);
    }
};

const std::set<std::string> of_stillness = {"diligent_ssr/reprojected_depth",
                                            "amd_sssr/reproject: motion vectors",
                                            "diligent_ssr/intersection: motion vectors",
                                            "diligent_ssr/temporal_accumulation: motion vectors",
                                            "frostbite_sssr/accumulate: motion vectors",
                                            "frostbite_sssr/classify: motion vectors",
                                            "frostbite_sssr/resolve: motion vectors",
                                            "simple_ssr/trace: motion vectors",
                                            "four_mode_ssr/blend: motion vectors"};
const std::set<std::string> of_mirrors = {"amd_sssr/prefilter: neighbours",
                                          "common/blue_noise",
                                          "diligent_ssr/bilateral_cleanup: neighbours",
                                          "frostbite_sssr/color_pyramid",
                                          "frostbite_sssr/trace_rough",
                                          "simple_ssr/blur_columns",
                                          "simple_ssr/blur_rows"};
const std::set<std::string> of_blackness = {"amd_sssr/intersect: environment", "diligent_ssr/intersection: environment",
                                            "frostbite_sssr/resolve: environment"};

std::set<std::string> united(std::initializer_list<std::set<std::string>> sets) {
    std::set<std::string> all = {"common/repair_inputs"};
    for (const auto& one : sets) all.insert(one.begin(), one.end());
    return all;
}

/// Shots share what is found once; none may get another's.
TEST_F(Needs, ManyShotsAreAnsweredAsEachAlone) {
    const auto text_of = [](const std::vector<LeftOutBy>& left_out) {
        std::string text;
        for (const auto& [who, part] : left_out)
            text += who + ": " + full_name(part) + ", " + part.fact + ", " + part.why + '\n';
        return text;
    };
    const std::vector<PointConfig> techniques = points();
    LeftOutFinder finder(techniques);
    const std::vector<Shot> shots = {shot("mirror_pillars", "main", {0}), shot("mirror_pillars", "main", {0, 1}),
                                     shot("all_rough", "main", {0}),      shot("moving_objects", "main", {0, 1}),
                                     shot("sky_only", "main", {0}),       shot("mirror_pillars", "main", {0})};
    std::set<std::string> different;
    for (const Shot& one : shots) {
        const std::string text = text_of(finder.of(one));
        EXPECT_EQ(text, text_of(left_out_of(one, techniques))) << one.name();
        different.insert(text);
    }
    EXPECT_GE(different.size(), 3u) << "the shots do not test much";
}

TEST_F(Needs, MirrorsThatNothingMovesBeforeABlackSky) {
    Shot still = shot("facing_mirrors", "yaw15", {0});
    still.scene.environment = {};
    still.facts = derive_facts(still.scene, still.camera, still.config.frames);
    EXPECT_EQ(left_out(still), united({of_stillness, of_mirrors, of_blackness}));
}

TEST_F(Needs, WhatMovesIsNotTakenForStill) {
    EXPECT_EQ(left_out(shot("passing_pillars", "lateral", {0, 1, 2, 3})), united({}));
}

TEST_F(Needs, WhereEverySurfaceReflectsNoneIsAsked) {
    Shot moving = shot("passing_pillars", "lateral", {0, 1, 2, 3});
    ASSERT_TRUE(moving.facts.has_matte);
    for (Material& material : moving.scene.materials) material.is_unlit = false, material.specular = 0.5f;
    moving.facts = derive_facts(moving.scene, moving.camera, moving.config.frames);
    std::set<std::string> askers;
    for (const char* stage : {"amd_sssr/classify", "diligent_ssr/mask", "frostbite_sssr/allocate",
                              "frostbite_sssr/classify", "mcguire_dda/trace", "simple_ssr/trace",
                              "simple_ssr/blur_rows", "simple_ssr/blur_columns", "four_mode_ssr/trace"})
        askers.insert(std::string(stage) + ": specular factors");
    EXPECT_EQ(left_out(moving), united({askers}));
}

TEST_F(Needs, PointsAreChosenByName) {
    EXPECT_EQ(all_points({"none"}).size(), 1u);
    EXPECT_EQ(all_points({"amd_sssr:corrected"}).front().preset, "corrected");
    EXPECT_GT(all_points().size(), 35u);
    EXPECT_THROW(all_points({"amd_ssr"}), Error);
}

}  // namespace
