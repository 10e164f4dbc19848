// ssrlab scene-for: a scene's views as another program needs them.
#include "core/cache_folder.h"
#include "core/error.h"
#include "core/list_text.h"
#include "core/near_miss.h"
#include "core/scene/load_scene.h"
#include "core/shown_text.h"
#include "experiments/bridges/scene_for/scene_folder.h"
#include "experiments/cli/commands.h"
#include "experiments/cli/frame_numbers.h"
#include "experiments/study/progress.h"

#include <algorithm>
#include <cstdio>

namespace {

struct SceneForOptions {
    std::string engine, scene;
    std::string animation;             ///< "": the scene's
    std::vector<std::string> cameras;  ///< empty: the scene's first
    std::vector<unsigned> size{480, 270};
    std::vector<std::string> frames{"0"};                                    ///< each one's number, or "0-63"
    unsigned samples = ReferenceSettings::default_samples, lit_samples = 0;  ///< of the light, as a study has them
    bool has_ladder = false;
    std::string fallback = "environment";  ///< or "probe"
    std::filesystem::path out;
};

const SceneEngine& engine_named(const std::string& name) {
    const auto& engines = scene_engines();
    const auto found = std::ranges::find(engines, name, &SceneEngine::name);
    if (found != engines.end()) return *found;
    const std::vector<std::string> names = names_of(engines, &SceneEngine::name);
    fail("scene-for: unknown engine '", shortened(name), "'", suggestion(name, names), "; known are: ", joined(names),
         "; 'any' writes all formats");
}

}  // namespace

static void scene_for_command(const SceneForOptions& options, const CommonOptions& common) {
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

void add_scene_for(Commands& line) {
    SceneForOptions& scene_for = line.keep<SceneForOptions>();
    CLI::App& command = line.add("scene-for",
                                 "Write a scene's views for another program: glTF, poses, and the light that its "
                                 "reflections are to be computed from");
    option(command, "engine ENGINE", scene_for.engine,
           "any, three, babylon, eevee or godot: decides the files' formats")
        ->required();
    add_scene(command, scene_for.scene);
    add_animation(command, scene_for.animation);
    option(command, "--camera NAME", scene_for.cameras, "One or more; default: the scene's first");
    add_size(command, scene_for.size);
    option(command, "--frames N", scene_for.frames,
           "Frames of the cameras' paths and of the animation, as 0-63 or 0 8 16")
        ->capture_default_str();
    option(command, "--samples", scene_for.samples,
           "Of the truth, per pixel: those of the study that will compare the images, which then finds it cached")
        ->check(CLI::Range(16, 1 << 24))
        ->capture_default_str();
    option(command, "--lit-samples", scene_for.lit_samples, "As the study's; default: all")
        ->check(CLI::Range(16, 1 << 24));
    command.add_flag("--ladder", scene_for.has_ladder, "The study has targets of the truth ladder");
    option(command, "--fallback", scene_for.fallback,
           "As the study's: what rays see that find nothing. A probe shows a room from the camera's place, where the "
           "environment is the sky behind its walls")
        ->check(CLI::IsMember({"environment", "probe"}))
        ->capture_default_str();
    option(command, "--out DIR", scene_for.out, "Folder")->required();
    add_scene_path(command, line.common), add_cache(command, line.common);
    add_reading(command);
    command.callback([&] { scene_for_command(scene_for, line.common); });
}
