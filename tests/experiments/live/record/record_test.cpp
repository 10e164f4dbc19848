// What `ssrlab record` refuses, and that a recording holds all that a technique does.
#include "experiments/live/record/record.h"
#include "core/gbuffer/gbuffer_transfer.h"
#include "core/gpu/device.h"
#include "experiments/live/record/recorder.h"
#include "experiments/live/record/sliders.h"
#include "experiments/live/record/texel_stream.h"
#include "experiments/study/config/points/all_points.h"
#include "experiments/study/measuring/rehearsal.h"
#include "experiments/study/measuring/render_technique.h"
#include "tests/error_message.h"
#include "tests/experiments/cli/command_line_fixture.h"

#include <set>

using nlohmann::json;

namespace {

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// Three frames of a technique on an empty G-buffer.
struct SmallRecording {
    RecordedTexels texels;
    KnownReads reads;
    json images, programs, lists, frames = json::array();
    std::set<unsigned> params_read;
    std::vector<std::vector<std::string>> stages;  ///< that were timed, of each frame

    explicit SmallRecording(const PointConfig& point) {
        Device device;
        const HostGBuffer empty = empty_gbuffer({45, 27});
        const Renderer renderer(device, empty.extent(), point);
        PassList inputs(device, empty.extent());
        Recorder recorder(*renderer.pass_list, texels, reads);
        for (unsigned index = 0; index < 3; ++index) {
            const GBuffer gbuffer = upload_gbuffer(inputs, empty);
            CameraData camera = empty.camera;
            camera.frame.x = index, camera.frame.w = index > 0;
            recorder.begin_frame(gbuffer);
            const Reflections reflections = renderer.render(camera, 1, gbuffer);
            frames.push_back(recorder.end_frame(reflections));
            stages.emplace_back();
            for (const PassTime& time : renderer.pass_list->times()) stages.back().push_back(time.stage);
        }
        images = recorder.images(), programs = recorder.programs(), lists = recorder.command_lists();
        params_read = recorder.params_read();
    }
};

}  // namespace

TEST_F(CommandLine, RecordRefusesWhatNoBrowserCanReplay) {
    const std::string record = "record mirror_pillars --size 32 18 --samples 1 --out page.html ";
    expect_mistake(record + "--technique mcguire_dda", "pass mcguire_dda/trace is a compute shader");
    expect_mistake(record + "--technique none", "none has no passes");
    expect_mistake(record + "--technique diligent_ssr --preset vulkan", "pass diligent_ssr/depth_hierarchy");
    expect_mistake(record + "--technique diligent_sr", "did you mean 'diligent_ssr'?");
    expect_mistake(record + "--technique diligent_ssr --preset curent", "did you mean 'current'?");
    expect_mistake(record + "--technique diligent_ssr --set roughness_treshold=1",
                   "did you mean 'roughness_threshold'?");
    expect_mistake(record + "--technique diligent_ssr --frames 5-2", "ends before it begins");
    expect_mistake(record + "--technique diligent_ssr --frames all", "--frames: 'all' must be a frame");
    expect_mistake(record + "--technique diligent_ssr --frames 0-5000", "more than the 1000 that a page holds");
    expect_mistake(record + "--technique diligent_ssr --camera man", "did you mean 'main'?");
    expect_mistake("record mirror_pilars --technique diligent_ssr --out page.html", "did you mean 'mirror_pillars'?");
    expect_mistake("record mirror_pillars --technique diligent_ssr --size 1920 1080 --frames 0-9 --out page.html",
                   "record fewer or smaller frames");
    EXPECT_FALSE(fs::exists(folder / "page.html"));
}

TEST(Record, HoldsEveryPassAndEveryImage) {
    const SmallRecording recording(single_point("diligent_ssr", "", {{"previous_frame", true}}));
    ASSERT_EQ(recording.frames.size(), 3u);
    std::set<size_t> written;
    for (size_t i = 0; i < recording.images.size(); ++i)
        if (recording.images[i].contains("texels")) written.insert(i);
    for (size_t f = 0; f < 3; ++f) {
        const json& frame = recording.frames[f];
        std::set<std::string> stages;
        for (const auto& [image, texels] : frame["inputs"].items()) {
            written.insert(std::stoul(image));
            EXPECT_LT(texels.get<size_t>(), recording.texels.texts().size());
        }
        for (const json& command : recording.lists[frame["commands"].get<size_t>()]) {
            if (command.contains("clear")) {
                written.insert(command["clear"][0].get<size_t>());
                stages.insert("clear");
                continue;
            }
            if (command.contains("upload")) {
                written.insert(command["upload"].get<size_t>());
                continue;
            }
            const json& program = recording.programs[command["program"].get<size_t>()];
            stages.insert(program["stage"]);
            for (const json& texture : command["textures"]) {
                EXPECT_TRUE(written.contains(texture[1].get<size_t>()))
                    << program["stage"] << " reads " << texture[0] << ", which nothing has written, in frame " << f;
                EXPECT_TRUE(has(program["fragment"], texture[0]));
            }
            EXPECT_FALSE(command["targets"].empty());
            for (const json& target : command["targets"]) {
                const json& image = recording.images[target[0].get<size_t>()];
                EXPECT_LT(target[1], image["mips"]) << image;
                written.insert(target[0].get<size_t>());
            }
            if (command.contains("depth")) {
                EXPECT_TRUE(written.contains(command["depth"][0].get<size_t>()));
            }
        }
        EXPECT_EQ(stages, std::set(recording.stages[f].begin(), recording.stages[f].end())) << "frame " << f;
        EXPECT_TRUE(written.contains(frame["radiance"].get<size_t>()));
    }
    // Histories change sides, so that two lists of commands serve all frames but the first, which also clears them.
    EXPECT_EQ(recording.lists.size(), 3u);
}

TEST(Record, HoldsMipsOfOddSizesAndStencils) {
    const SmallRecording recording(single_point("diligent_ssr", "april_2024"));
    const auto pyramid =
        std::ranges::find_if(recording.images, [](const json& image) { return image["name"] == "depth_pyramid"; });
    ASSERT_NE(pyramid, recording.images.end());
    EXPECT_EQ((*pyramid)["width"], 45);
    EXPECT_EQ((*pyramid)["height"], 27);
    EXPECT_GE((*pyramid)["mips"], 6);
    const json& list = recording.lists[recording.frames[0]["commands"].get<size_t>()];
    EXPECT_TRUE(std::ranges::any_of(list, [](const json& c) { return c.contains("stencil") && c["stencil"][1]; }));
    EXPECT_TRUE(std::ranges::any_of(list, [](const json& c) { return c.contains("stencil") && !c["stencil"][1]; }));
}

TEST(Record, HasSlidersForWhatOnlyShadersRead) {
    Device device;
    const PointConfig point = single_point("diligent_ssr");
    SmallRecording recording(point);
    const json parameters = recorded_parameters(device, point, {32, 18}, recording.params_read, recording.reads);
    std::map<std::string, json> by_name;
    for (const json& p : parameters) by_name[p["name"]] = p;
    for (const char* name : {"roughness_threshold", "temporal_radiance_stability_factor", "ggx_importance_sample_bias"})
        EXPECT_TRUE(by_name.at(name)["is_slider"]) << by_name.at(name);
    EXPECT_EQ(by_name.at("mask")["why_not"], "compiled into the shaders");
    EXPECT_EQ(by_name.at("dda.thickness")["why_not"], "no recorded shader reads it");
    EXPECT_FALSE(by_name.at("dda.thickness")["is_slider"]);
}

TEST(Record, LeavesOutLowestBitsThatAreZero) {
    HostImage image({5, 3}, 2);
    for (size_t i = 0; i < image.pixel_count(); ++i) {
        image.values[2 * i] = float(i) - 7.5f;               // 5 bits of significand
        image.values[2 * i + 1] = 1.0f / (float(i) - 7.3f);  // all of them
    }
    const TexelStream stream = encode_floats(image);
    ASSERT_EQ(stream.shifts.size(), 2u);
    EXPECT_GE(stream.shifts[0], 19u);
    EXPECT_EQ(stream.shifts[1], 0u);
    RecordedTexels texels;
    EXPECT_EQ(texels.add(image), 0u);
    EXPECT_EQ(texels.add(HostImage({5, 3}, 2)), 1u);
    EXPECT_EQ(texels.add(image), 0u) << "what comes twice is kept once";
}
