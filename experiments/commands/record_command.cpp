// ssrlab record: a technique as one page that does its passes again in a browser.
#include "core/cache_folder.h"
#include "core/gpu/device.h"
#include "core/scene/load_scene.h"
#include "core/shown_text.h"
#include "experiments/commands/commands.h"
#include "experiments/commands/frame_numbers.h"
#include "experiments/config/points/all_points.h"
#include "experiments/record/record.h"
#include "experiments/run/progress.h"

#include <cstdio>

namespace {

std::string listed(const std::vector<std::string>& names) {
    std::string text;
    for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
    return text.empty() ? "none" : text;
}

}  // namespace

void record_command(const RecordOptions& options, const CommonOptions& common) {
    const VariantConfig point = single_point(options.variant, options.preset, options.parameters);
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
    std::printf("sliders: %s\n", listed(page.sliders).c_str());
}
