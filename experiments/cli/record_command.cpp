// ssrlab record: a technique as one page that does its passes again in a browser.
#include "core/cache_folder.h"
#include "core/gpu/device.h"
#include "core/list_text.h"
#include "core/scene/load_scene.h"
#include "core/shown_text.h"
#include "experiments/cli/commands.h"
#include "experiments/cli/frame_numbers.h"
#include "experiments/live/record/record.h"
#include "experiments/study/config/points/all_points.h"
#include "experiments/study/progress.h"

#include <cstdio>

namespace {

struct RecordOptions {
    ShotOptions shot{.size = {192, 108}};           ///< its frame is not looked at
    std::string technique, preset, frames = "0-7";  ///< a frame, or a range with both ends
    nlohmann::json parameters = nlohmann::json::object();
    unsigned samples = 256;
    bool is_packed = false, has_results = false, has_passes = false;
    std::filesystem::path out;
};

std::string names_or_none(const std::vector<std::string>& names) { return names.empty() ? "none" : joined(names); }

}  // namespace

static void record_command(const RecordOptions& options, const CommonOptions& common) {
    const PointConfig point = single_point(options.technique, options.preset, options.parameters);
    constexpr size_t most_frames = 1000;
    const std::vector<unsigned> frames = frame_numbers({&options.frames, 1}, most_frames, "a page");
    Device device(common.device);
    Progress progress(1.0);
    const RecordedPage page = record_page(
        device, {.shot = {.scene = options.shot.scene,
                          .choices = {.animation = options.shot.animation},
                          .camera = options.shot.camera,
                          .has_planes_of_scene = options.shot.has_planes_of_scene(),
                          .extent = {options.shot.size[0], options.shot.size[1]},
                          .frames = frames,
                          .gbuffer_formats = options.is_packed ? GBufferFormats::packed : GBufferFormats::exact},
                 .point = point,
                 .samples = options.samples,
                 .has_results = options.has_results,
                 .has_passes = options.has_passes,
                 .page = options.out,
                 .cache = common.cache.empty() ? default_cache_folder() : common.cache,
                 .search_path = scene_search_path(common.scene_path),
                 .say = [&](const std::string& text) { progress.say(shown_text(text)); },
                 .report = [&](double share, const std::string& what) { progress.update(share, what); }});
    progress.say(shown_text(options.out.string()));
    std::printf("%s of %u passes, %.2f MB; relmse of the last frame %.4g\n",
                counted(page.errors.size(), "frame").c_str(), page.passes, double(page.bytes) * 1e-6,
                page.errors.back());
    std::printf("sliders: %s\n", names_or_none(page.sliders).c_str());
}

void add_record(Commands& line) {
    RecordOptions& record = line.keep<RecordOptions>();
    CLI::App& command = line.add(
        "record",
        "Write a page on which a browser runs a technique's passes (WebGL 2) and compares the result with the truth",
        "ssrlab record mirror_pillars --technique diligent_ssr --packed --out page.html");
    add_scene(command, record.shot.scene);
    option(command, "--technique NAME", record.technique,
           "Technique that has only fragment passes (see: ssrlab list techniques), or its folder; other techniques are "
           "refused")
        ->required();
    add_values(command, record.preset, record.parameters);
    option(command, "--camera NAME", record.shot.camera, "Camera of the scene, by name; default: the first");
    add_planes(command, record.shot);
    add_animation(command, record.shot.animation);
    add_size(command, record.shot.size, "192 108");
    option(command, "--frames A-B", record.frames, "Frames of the camera's path and of the animation")
        ->capture_default_str();
    option(command, "--samples N", record.samples, "Samples per pixel of the truth")
        ->check(CLI::Range(1, 1 << 24))
        ->capture_default_str();
    command.add_flag("--packed", record.is_packed,
                     "Store the G-buffer in the formats of engines, which makes the page smaller; default: float32");
    command.add_flag("--results", record.has_results,
                     "Also store what this device rendered, so that the page shows where the browser differs");
    command.add_flag("--passes", record.has_passes,
                     "Also store what each pass wrote on this device, so that the page compares pass by pass");
    option(command, "--out PAGE.html", record.out, "Output file")->required();
    add_device(command, line.common), add_scene_path(command, line.common), add_cache(command, line.common);
    add_reading(command);
    command.callback([&] { record_command(record, line.common); });
}
