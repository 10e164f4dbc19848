// ssrlab record: a technique as one page that does its passes again in a browser.
#include "core/cache_folder.h"
#include "core/error.h"
#include "core/gpu/device.h"
#include "core/scene/load_scene.h"
#include "core/shown_text.h"
#include "experiments/commands/commands.h"
#include "experiments/config/all_points.h"
#include "experiments/record/record.h"
#include "experiments/run/progress.h"

#include <re2/re2.h>
#include <cstdio>
#include <numeric>

namespace {

constexpr unsigned most_frames = 1000;

/// Of "7" or "3-12".
std::vector<unsigned> frames_of(const std::string& text) {
    static const RE2 single(R"((\d{1,6}))"), range(R"((\d{1,6})-(\d{1,6}))");
    unsigned first = 0, last = 0;
    if (RE2::FullMatch(text, single, &first))
        last = first;
    else if (!RE2::FullMatch(text, range, &first, &last))
        fail("--frames takes a frame or a range such as 0-9, not '", shown_text(text), "'");
    if (last < first) fail("--frames ", text, " ends before it begins");
    const unsigned count = last - first + 1;
    if (count > most_frames) fail("--frames ", text, " are ", count, " frames; a page holds ", most_frames);
    std::vector<unsigned> frames(count);
    std::iota(frames.begin(), frames.end(), first);
    return frames;
}

std::string listed(const std::vector<std::string>& names) {
    std::string text;
    for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
    return text.empty() ? "none" : text;
}

}  // namespace

void record_command(const RecordOptions& options, const CommonOptions& common) {
    const VariantConfig point = single_point(options.variant, options.preset, options.parameters);
    const std::vector<unsigned> frames = frames_of(options.frames);
    Device device(common.device);
    Progress progress(1.0);
    const RecordedPage page = record_page(
        device, {.shot = {.scene = options.shot.scene,
                          .camera = options.shot.camera,
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
    progress.say(options.out.string());
    std::printf("%zu frames of %u passes, %.2f MB; relmse of the last frame %.4g\n", page.errors.size(), page.passes,
                double(page.bytes) * 1e-6, page.errors.back());
    std::printf("sliders: %s\n", listed(page.sliders).c_str());
}
