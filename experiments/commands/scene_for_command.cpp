// ssrlab scene-for: a scene's views as another program needs them.
#include "core/cache_folder.h"
#include "core/error.h"
#include "core/near_miss.h"
#include "core/scene/load_scene.h"
#include "core/shown_text.h"
#include "experiments/commands/commands.h"
#include "experiments/run/progress.h"
#include "experiments/scene_for/scene_folder.h"

#include <algorithm>
#include <cstdio>
#include <set>

namespace {

const SceneEngine& engine_named(const std::string& name) {
    const auto& engines = scene_engines();
    const auto found = std::ranges::find(engines, name, &SceneEngine::name);
    if (found != engines.end()) return *found;
    std::vector<std::string> names;
    for (const SceneEngine& engine : engines) names.push_back(engine.name);
    std::string list;
    for (const std::string& known : names) list += (list.empty() ? "" : ", ") + known;
    fail("scene-for: unknown engine '", shortened(name), "'", suggestion(name, names), "; known are: ", list,
         "; 'any' writes all formats");
}

/// Ascending, of "3" and "0-63".
std::vector<unsigned> frames_of(const std::vector<std::string>& texts) {
    constexpr unsigned most_frames = 10000, last_frame = 999999;
    std::set<unsigned> frames;
    for (const std::string& text : texts) {
        unsigned first = 0, last = 0;
        int end = 0;
        const auto is_whole = [&] { return end > 0 && size_t(end) == text.size(); };
        const bool has_digits = text.find_first_not_of("0123456789-") == text.npos && text.size() < 16;
        if (has_digits && std::sscanf(text.c_str(), "%6u-%6u%n", &first, &last, &end) == 2 && is_whole()) {
        } else if (end = 0; has_digits && std::sscanf(text.c_str(), "%6u%n", &first, &end) == 1 && is_whole()) {
            last = first;
        } else {
            fail("--frames: '", shortened(text),
                 "' must be a frame, as 3, or the first and the last of several, as 0-63, up to ", last_frame);
        }
        if (last < first) fail("--frames: '", text, "' runs backwards");
        if (last - first >= most_frames)
            fail("--frames: '", text, "' are ", last - first + 1, " frames, of which ", most_frames, " are allowed");
        for (unsigned frame = first; frame <= last; ++frame) frames.insert(frame);
    }
    return {frames.begin(), frames.end()};
}

}  // namespace

void scene_for_command(const SceneForOptions& options, const CommonOptions& common) {
    const SceneEngine& engine = engine_named(options.engine);
    const std::vector<unsigned> frames = frames_of(options.frames);
    Progress progress(1.0);
    const SceneFolder written =
        write_scene_folder({.engine = engine,
                            .scene = options.scene,
                            .cameras = options.cameras,
                            .extent = {options.size[0], options.size[1]},
                            .frames = frames,
                            .reference = {.max_samples = options.samples,
                                          .lit_samples = options.lit_samples,
                                          .ladder = options.has_ladder},
                            .has_probe = options.fallback == "probe",
                            .out = options.out,
                            .cache = common.cache.empty() ? default_cache_folder() : common.cache,
                            .search_path = scene_search_path(common.scene_path),
                            .say = [&](const std::string& text) { progress.say(text); },
                            .report = [&](double share, const std::string& what) { progress.update(share, what); }});
    for (const std::string& warning : written.warnings)
        std::fprintf(stderr, "warning: %s\n", shown_text(warning).c_str());
    for (const std::string& view : written.views) progress.say(shown_text((options.out / view).string()));
    std::printf("%s: %s, %zu light images (%zu from the cache)\n",
                shown_text((options.out / "scene.json").string()).c_str(),
                counted(written.views.size(), "view").c_str(), written.rendered + written.cached, written.cached);
}
