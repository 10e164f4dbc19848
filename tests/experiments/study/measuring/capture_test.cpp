// Captures: what is played after what, what is refused, what is warned of. A wall at a known distance stands for an
// engine.
#include "experiments/study/measuring/frames/capture.h"
#include "core/error.h"
#include "core/exr/exr.h"
#include "core/files.h"
#include "core/gbuffer/gbuffer_checks.h"
#include "core/gbuffer/pixel_position.h"
#include "core/json.h"
#include "core/list_text.h"

#include <gtest/gtest.h>
#include <filesystem>
#include <glm/gtc/matrix_transform.hpp>

namespace fs = std::filesystem;

namespace {

constexpr glm::uvec2 extent(48, 32);
constexpr float wall_z = -5;  // m

/// The camera of frame `frame`: it looks 40 degrees to the right of the wall, and steps by 0.1 m along it.
CameraPose pose(float frame) {
    CameraPose pose{.near = 0.1f, .far = 50};
    pose.world_from_view = glm::translate(glm::mat4(1), glm::vec3(0.1f * frame, 0.3f, 0)) *
                           glm::rotate(glm::mat4(1), glm::radians(-40.0f), glm::vec3(0, 1, 0));
    return pose;
}

CameraData camera(float frame) {
    const CameraPose now = pose(frame), before = pose(frame - 1);
    return camera_data(now, &before, {.extent = extent});
}

/// A wall across all of the image, with the motion vectors and the previous depth of an exporter that has them.
HostGBuffer wall(float frame) {
    HostGBuffer g{.camera = camera(frame), .depth = HostImage(extent, 1)};
    for (HostImage HostGBuffer::*image :
         {&HostGBuffer::geometric_normal, &HostGBuffer::normal, &HostGBuffer::base_color, &HostGBuffer::emission,
          &HostGBuffer::previous_normal, &HostGBuffer::lit, &HostGBuffer::fallback})
        g.*image = HostImage(extent, 4, 0.5f);
    g.motion = HostImage(extent, 2), g.material_id = HostImage(extent, 1, 1), g.previous_depth = g.depth;
    const glm::dmat4 clip_from_world(g.camera.clip_from_world);
    for (size_t i = 0; i < g.depth.pixel_count(); ++i) {
        const glm::dvec3 eye(g.camera.world_from_view[3]), direction = view_direction(g, i);
        const glm::dvec4 at = clip_from_world * glm::dvec4(eye + direction * (wall_z - eye.z) / direction.z, 1);
        g.depth.values[i] = float(at.z / at.w);
        for (HostImage* normal : {&g.geometric_normal, &g.normal, &g.previous_normal}) normal->set_rgb(i, {0, 0, 1});
    }
    CameraData before = g.camera;
    before.clip_from_world = g.camera.previous_clip_from_world;
    g.motion = camera_motion(g, before);
    g.previous_depth = g.depth;  // the camera steps along the wall: all frames have the same depths
    return g;
}

struct CaptureTest : testing::Test {
    fs::path folder = fs::temp_directory_path() / "capture_test";
    void SetUp() override { fs::remove_all(folder); }
    void TearDown() override { fs::remove_all(folder); }

    fs::path place(unsigned frame) const { return folder / ("frame_000" + std::to_string(frame)); }
    void write(unsigned first, unsigned last) const {
        for (unsigned frame = first; frame <= last; ++frame) save_gbuffer(place(frame), wall(float(frame)));
    }
    /// Removes layers (by the start of their names) of a frame, or all keys of a camera that start so.
    void remove_layers(unsigned frame, const std::string& start) const {
        LayeredImage file = read_exr(place(frame) / "gbuffer.exr");
        std::erase_if(file.layers, [&](const Layer& layer) { return layer.name.starts_with(start); });
        write_exr(place(frame) / "gbuffer.exr", file);
    }
    void change_camera(unsigned frame, const std::function<void(nlohmann::json&)>& change) const {
        nlohmann::json camera = read_json(place(frame) / "camera.json");
        change(camera);
        write_text(place(frame) / "camera.json", camera.dump());
    }
    CaptureContents inspect(const std::vector<unsigned>& frames = {}) const {
        Capture capture(folder);
        const ShotConfig config{.frames = frames.empty() ? capture.frames() : frames, .gbuffer = folder};
        return inspect_capture(capture_shot(config, capture), capture);
    }
    std::string refusal(const std::vector<unsigned>& frames = {}) const {
        try {
            inspect(frames);
        } catch (const Error& e) {
            return e.what();
        }
        return "nothing was wrong";
    }
    std::string notes() const {
        std::string all;
        for (const std::string& note : inspect().notes) all += note + "\n";
        return all;
    }
};

#define EXPECT_SAYS(text, part) EXPECT_NE((text).find(part), std::string::npos) << (text)

/// The sign and unit of motion vectors as another engine may have them.
HostGBuffer with_motion(HostGBuffer g, glm::vec2 factor) {
    for (size_t i = 0; i < g.motion.values.size(); ++i) g.motion.values[i] *= factor[int(i % 2)];
    return g;
}

HostGBuffer with_normals(HostGBuffer g, const std::function<glm::vec3(glm::vec3)>& change) {
    for (size_t i = 0; i < g.normal.pixel_count(); ++i) g.normal.set_rgb(i, change(g.normal.rgb(i)));
    return g;
}

}  // namespace

TEST_F(CaptureTest, WhatIsPlayedBeforeDecides) {
    write(3, 5);
    Capture capture(folder);
    EXPECT_EQ(capture.frames(), (std::vector<unsigned>{3, 4, 5}));
    EXPECT_EQ(notes(), "");
    const HostGBuffer now = wall(4);
    // Along the wall by 0.1 m, seen from 5 m: not by nothing.
    ASSERT_GT(std::abs(now.motion.values[0]) * extent.x, 0.3f);

    const HostGBuffer first = capture.played(4, {}), held = capture.played(4, 4), next = capture.played(4, 3),
                      back = capture.played(4, 5);
    for (const HostGBuffer* still : {&first, &held}) {
        EXPECT_EQ(still->motion.values, HostImage(extent, 2).values);
        EXPECT_EQ(still->camera.previous_clip_from_world, now.camera.clip_from_world);
    }
    EXPECT_EQ(first.camera.frame.w, 0u);
    EXPECT_EQ(held.camera.frame.w, 1u);
    EXPECT_EQ(next.motion.values, now.motion.values);
    EXPECT_EQ(next.camera.previous_view_from_world, camera(3).view_from_world);
    EXPECT_EQ(back.camera.previous_view_from_world, camera(5).view_from_world);
    for (size_t i = 0; i < now.motion.values.size(); ++i)
        ASSERT_NEAR(back.motion.values[i], -now.motion.values[i], 0.1f * std::abs(now.motion.values[i]) + 1e-5f)
            << "the way back over a step of 0.1 m at 5 m: perspective changes it by some per cent";
}

TEST_F(CaptureTest, WithoutMotionOrPreviousCameraTheFrameBeforeTellsThem) {
    write(0, 2);
    for (unsigned frame = 0; frame < 3; ++frame) {
        remove_layers(frame, "motion"), remove_layers(frame, "previous_");
        change_camera(frame, [](nlohmann::json& camera) {
            for (const char* key :
                 {"clip_from_view", "view_from_world", "clip_from_world", "world_from_view", "view_from_clip"})
                camera.erase(std::string("previous_") + key);
        });
    }
    EXPECT_SAYS(notes(), "no layer 'motion': it is derived from depth and cameras");
    Capture capture(folder);
    const HostGBuffer stored = wall(1), derived = capture.played(1, 0);
    for (size_t i = 0; i < stored.motion.values.size(); ++i)
        ASSERT_NEAR(derived.motion.values[i], stored.motion.values[i], 1e-6f);  // float32 matrices, of other products
    EXPECT_EQ(derived.camera.previous_clip_from_world, camera(0).clip_from_world);
    EXPECT_EQ(derived.camera.frame.w, 1u);
}

TEST_F(CaptureTest, TheEnvironmentFillsAnAbsentFallback) {
    write(0, 0);
    write_text(folder / "environment.json",
               R"({"gradient": {"color": [1, 1, 1], "slope": [0.5, 0.5, 0.5], "axis": [0, 0, 1]}})");
    remove_layers(0, "fallback");
    Capture capture(folder);
    const HostGBuffer g = capture.load(0).gbuffer;
    EXPECT_FALSE(capture.load(0).absent.contains("fallback"));
    // Of a linear gradient, the mean over a lobe that is narrow lies near the radiance along its axis; roughness 0.5
    // spreads it by tens of degrees, which moves a slope of 0.5 by less than 0.2.
    const size_t middle = size_t(extent.y / 2) * extent.x + extent.x / 2;
    const double z = glm::reflect(view_direction(g, middle), glm::dvec3(0, 0, 1)).z;
    EXPECT_NEAR(g.fallback.rgb(middle).r, 1 + 0.5 * z, 0.2);
    EXPECT_GT(g.fallback.rgb(middle).r, 1.1f);
}

TEST_F(CaptureTest, BrokenSequencesAreRefusedWithThePlace) {
    write(0, 3);
    EXPECT_SAYS(refusal({0, 2}), "frame 0 is followed by 2");
    EXPECT_SAYS(refusal({3, 4}), "frame 4 is missing; there are 4 frames from 0 to 3");

    fs::remove_all(place(2));
    EXPECT_SAYS(refusal(), "frame 1 is followed by 3");
    fs::rename(place(3), place(2));  // renumbered, as if none were missing
    EXPECT_SAYS(refusal(), "frame_0002/camera.json: its previous camera is not that of frame 1");

    save_gbuffer(place(2), wall(2));
    HostGBuffer other = wall(1);
    for (float& depth : other.previous_depth.values) depth = 0.5f;
    save_gbuffer(place(1), other);
    EXPECT_SAYS(refusal(), "frame_0001/gbuffer.exr: previous_depth is not the depth of frame 0");

    other = wall(1);
    other.depth_format = DepthFormat::d16;
    save_gbuffer(place(1), other);
    EXPECT_SAYS(refusal(), "frame_0001 is 48x32, d16, standard depth, perspective, but the first frame is 48x32, d32f");

    save_gbuffer(place(1), wall(1));
    remove_layers(1, "lit");
    EXPECT_SAYS(refusal(), "frame_0001/gbuffer.exr lacks the layer 'lit', which the first frame has");

    fs::rename(place(1), folder / "frame_one");
    EXPECT_SAYS(refusal(), "frame_one: a frame's folder is called frame_<number>");
    fs::rename(folder / "frame_one", folder / "frame_02");
    EXPECT_SAYS(refusal(), "frame 2 is there twice");
    save_gbuffer(folder, wall(0));
    fs::remove_all(folder / "frame_02");
    EXPECT_SAYS(refusal(), "holds both a gbuffer.exr and folders");
}

TEST_F(CaptureTest, ACutOfTheCameraIsSaid) {
    write(0, 2);
    CameraPose far_away = pose(2);
    far_away.world_from_view[3].x += 20;
    const CameraPose before = pose(1);
    HostGBuffer cut = wall(2);
    cut.camera = camera_data(far_away, &before, {.extent = extent});
    cut.motion = camera_motion(cut, camera(1));
    save_gbuffer(place(2), cut);
    EXPECT_SAYS(notes(), "frame 2: The camera jumps: 100 % of what is seen was outside");
}

/// One matte pixel of one frame is enough, and so is a value that repair_inputs would take for 0.
TEST_F(CaptureTest, EverySurfaceReflectsOnlyIfAllPixelsOfAllFramesDo) {
    const auto has_matte = [&](const std::function<void(HostGBuffer&)>& change) {
        HostGBuffer first = wall(0), second = wall(1);
        for (HostGBuffer* g : {&first, &second})
            for (size_t i = 3; i < g->emission.values.size(); i += 4) g->emission.values[i] = 1;
        change(second);
        save_gbuffer(place(0), first), save_gbuffer(place(1), second);
        return inspect().facts.has_matte;
    };
    EXPECT_FALSE(has_matte([](HostGBuffer&) {}));
    EXPECT_TRUE(
        has_matte([](HostGBuffer& g) { g.emission.values[4 * 7 + 3] = 0, g.base_color.values[4 * 7 + 3] = 0; }));
    EXPECT_FALSE(
        has_matte([](HostGBuffer& g) { g.emission.values[4 * 7 + 3] = 0, g.base_color.values[4 * 7 + 3] = 1; }));
    EXPECT_TRUE(has_matte([](HostGBuffer& g) { g.emission.values[4 * 7] = std::nanf(""); }));
}

TEST_F(CaptureTest, AnotherConventionOfMotionIsNamed) {
    const HostGBuffer before = wall(1), now = wall(2);
    EXPECT_EQ(joined(check_motion(before, now)), "");
    for (const auto& [factor, name] : {std::pair<glm::vec2, std::string>({-1, -1}, "taken as before - now."),
                                       {glm::vec2(extent), "taken as pixels."},
                                       {{-2, -2}, "taken as clip space (-1 to 1), before - now."}})
        EXPECT_SAYS(joined(check_motion(before, with_motion(now, factor))), name);
    HostGBuffer lost = wall(1);
    for (float& depth : lost.depth.values) depth = 0.5f;
    EXPECT_SAYS(joined(check_motion(lost, now)), "Only 0 % of the surfaces are found");
}

TEST_F(CaptureTest, AnotherConventionOfNormalsOrCameraIsNamed) {
    const HostGBuffer g = wall(0);
    EXPECT_EQ(joined(check_gbuffer(g)), "");
    const glm::mat3 view_from_world(g.camera.view_from_world);
    EXPECT_SAYS(joined(check_gbuffer(with_normals(g, [&](glm::vec3 n) { return view_from_world * n; }))),
                "taken in view space. They must be in world space");
    EXPECT_SAYS(joined(check_gbuffer(with_normals(g, [](glm::vec3 n) { return -n; }))), "pointing into the surface");
    EXPECT_SAYS(joined(check_gbuffer(with_normals(g, [](glm::vec3) { return glm::vec3(1, 0, 0); }))),
                "check their space");

    HostGBuffer upside_down = g;
    upside_down.camera.clip_from_view[1][1] *= -1;
    EXPECT_SAYS(joined(check_gbuffer(upside_down)), "clip space with y up, as OpenGL");
    HostGBuffer reversed = g;
    reversed.camera.depth.z = 0, reversed.camera.depth.w = 1;
    EXPECT_SAYS(joined(check_gbuffer(reversed)), "'clip_from_view' gives the depths 0.0");
}

TEST_F(CaptureTest, ReferencesAreNamedByAPattern) {
    ShotConfig config{.reference = "of_#/truth_####.exr"};
    EXPECT_EQ(capture_reference_file(config, 7), "of_#/truth_0007.exr");
    EXPECT_EQ(capture_reference_file(config, 12345), "of_#/truth_12345.exr");
    config.reference = "one.exr";
    EXPECT_EQ(capture_reference_file(config, 7), "one.exr");
}

// Names of folders may have number signs in them, as names of takes have.
TEST_F(CaptureTest, NumberSignsOfFoldersAreNoPattern) {
    const fs::path take = folder / "take#2";
    const auto file_of = [&](const std::string& reference) {
        write_text(take / "cap/gbuffer.exr", "not read here");
        write_text(take / "study.json", R"({"shots": [{"gbuffer": "cap", "reference": ")" + reference +
                                            R"("}], "techniques": [{"technique": "none"}]})");
        return capture_reference_file(read_config(take / "study.json").shots.at(0), 7);
    };
    EXPECT_EQ(file_of("truth.exr"), take / "truth.exr");
    EXPECT_EQ(file_of("truth_##.exr"), take / "truth_07.exr");
    EXPECT_EQ(file_of("of_#/truth.exr"), take / "of_7/truth.exr");
    EXPECT_EQ(file_of((take / "truth.exr").string()), take / "truth.exr");
    const fs::path other = folder / "take#3/truth.exr";  // outside of the study's folder
    EXPECT_EQ(file_of(other.string()), folder / "take73/truth.exr");
    write_text(other, "a file of that name");
    EXPECT_EQ(file_of(other.string()), other);
}
