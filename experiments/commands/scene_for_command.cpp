// ssrlab scene-for: a scene's views as another program needs them.
#include "core/cache_folder.h"
#include "core/error.h"
#include "core/near_miss.h"
#include "core/scene/load_scene.h"
#include "core/shown_text.h"
#include "experiments/commands/commands.h"
#include "experiments/commands/frame_numbers.h"
#include "experiments/run/progress.h"
#include "experiments/scene_for/scene_folder.h"

#include <algorithm>
#include <cstdio>

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

}  // namespace

void scene_for_command(const SceneForOptions& options, const CommonOptions& common) {
    const SceneEngine& engine = engine_named(options.engine);
    constexpr size_t most_frames = 10000;
    const std::vector<unsigned> frames = frame_numbers(options.frames, most_frames, "a folder");
    Progress progress(1.0);
    const SceneFolder written =
        write_scene_folder({.engine = engine,
                            .scene = options.scene,
                            .choices = {.animation = options.animation},
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
    std::printf("%s: %s, %s (%zu from the cache)\n", shown_text((options.out / "scene.json").string()).c_str(),
                counted(written.views.size(), "view").c_str(),
                counted(written.rendered + written.cached, "light image").c_str(), written.cached);
}
