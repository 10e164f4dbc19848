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
                                 "Write the views of a scene for another program: glTF, camera poses, and the light "
                                 "that reflections are computed from",
                                 "ssrlab scene-for three fence --out fence_scene");
    option(command, "engine ENGINE", scene_for.engine,
           "Program that will read the files: any, three, babylon, eevee or godot. It decides the formats")
        ->required();
    add_scene(command, scene_for.scene);
    add_animation(command, scene_for.animation);
    option(command, "--camera NAME", scene_for.cameras, "Cameras of the scene, one or more; default: the first");
    add_size(command, scene_for.size);
    option(command, "--frames N", scene_for.frames,
           "Frames of the cameras' paths and of the animation, as 0-63 or 0 8 16")
        ->capture_default_str();
    option(command, "--samples", scene_for.samples,
           "Samples per pixel of the truth. Use the number of the study that will compare the images, which then finds "
           "the truth in the cache")
        ->check(CLI::Range(16, 1 << 24))
        ->capture_default_str();
    option(command, "--lit-samples", scene_for.lit_samples, "Samples of the lit colour, as in the study; default: all")
        ->check(CLI::Range(16, 1 << 24));
    command.add_flag("--ladder", scene_for.has_ladder, "The study has targets of the truth ladder");
    option(command, "--fallback", scene_for.fallback,
           "What rays that find nothing see, as in the study: the environment, or a probe at the camera's place, which "
           "shows the room instead of the sky behind the walls")
        ->check(name_among({"environment", "probe"}))
        ->capture_default_str();
    option(command, "--out DIR", scene_for.out, "Output folder")->required();
    add_scene_path(command, line.common), add_cache(command, line.common);
    add_reading(command);
    command.callback([&] { scene_for_command(scene_for, line.common); });
}
