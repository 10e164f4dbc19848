// ssrlab watch: a technique's folder, rendered and judged on every save.
#include "core/shown_text.h"
#include "core/signal_actions.h"
#include "experiments/cli/commands.h"
#include "experiments/cli/frame_numbers.h"
#include "experiments/live/watch/watch_session.h"

#include <unistd.h>
#include <algorithm>
#include <array>
#include <csignal>
#include <cstdio>

namespace {

struct WatchOptions {
    std::filesystem::path folder, out;
    std::vector<std::string> scenes;
    std::string against, camera, preset, frames = "0";  ///< a frame, or a range with both ends
    std::vector<unsigned> size{480, 270};
    unsigned samples = 256, seeds = 0;  ///< seeds 0: as studies have them
    double patience = 30;
};

volatile std::sig_atomic_t is_ended = 0;

/// Sets is_ended; a second signal ends the process, and with it what it started.
struct sigaction ending() {
    struct sigaction end {};
    end.sa_handler = [](int signal) {
        if (is_ended) _exit(128 + signal);
        is_ended = 1;
    };
    return end;
}

/// A scene's name, or what its path ends with, as a part of a folder's name: "hall" for "a/hall/scene.json", "room_5".
std::string plain_name(const std::string& scene) {
    std::filesystem::path path = std::filesystem::absolute(scene).lexically_normal();
    if (!path.has_filename() || path.filename() == "scene.json") path = path.parent_path();
    std::string name = path.stem().string();
    std::ranges::replace(name, ':', '_');
    return name;
}

/// Of its own for each technique and its scenes, whose numbers the folder holds.
std::filesystem::path default_folder(const std::string& technique, const std::vector<std::string>& scenes) {
    std::string name = technique;
    for (const std::string& scene : scenes) name += "." + plain_name(scene);
    return std::filesystem::path("results/watch") / name;
}

}  // namespace

static void watch_command(const WatchOptions& options, const std::vector<std::string>& run_options) {
    constexpr size_t most_frames = 1000;
    const std::filesystem::path folder =
        std::filesystem::weakly_canonical(std::filesystem::absolute(options.folder));  // "my_ssr/", ".", a link
    const SignalActions signals(std::array{SIGINT, SIGTERM}, ending(), SignalActions::Ignored::too);
    WatchSession session(
        {.folder = folder,
         .preset = options.preset,
         .scenes = options.scenes,
         .camera = options.camera,
         .extent = {options.size[0], options.size[1]},
         .frames = frame_numbers({&options.frames, 1}, most_frames, "a watch"),
         .against = options.against,
         .samples = options.samples,
         .seeds = options.seeds,
         .patience = options.patience,
         .out = options.out.empty() ? default_folder(folder.filename().string(), options.scenes) : options.out,
         .run_options = run_options});
    session.run([] { return is_ended != 0; },
                [](const std::string& text) {
                    std::printf("%s\n", shown_text(text).c_str());
                    std::fflush(stdout);
                });
}

void add_watch(Commands& line) {
    WatchOptions& watch = line.keep<WatchOptions>();
    CLI::App& command = line.add("watch",
                                 "Render and judge the folder of a technique whenever a file in it is saved, and show "
                                 "the result on a local web page",
                                 "ssrlab watch my_ssr --scene fence");
    option(command, "folder FOLDER", watch.folder, "Folder with technique.json and shaders (`ssrlab new` makes one)")
        ->required();
    option(command, "--scene SCENE...", watch.scenes,
           "Scenes, one or more, by name (see: ssrlab list scenes) or path; the first is shown first")
        ->required();
    option(
        command, "--against NAME", watch.against,
        "Also compare with this technique, as NAME or NAME:PRESET, or with another folder; best: frostbite_sssr:best, "
        "which errs least over the included scenes (in rooms, composed_ssr errs less)");
    option(command, "--preset NAME", watch.preset, "Preset of the technique; default: the default parameters");
    option(command, "--camera NAME", watch.camera, "Camera of the scenes, by name; default: the first of each scene");
    add_size(command, watch.size);
    option(command, "--frames A-B", watch.frames,
           "Frames of the camera's path and of the animation, which fill histories; the last frame is measured")
        ->capture_default_str();
    option(command, "--samples N", watch.samples, "Samples per pixel of the truth")
        ->check(CLI::Range(32, 1 << 20))
        ->capture_default_str();
    option(command, "--seeds N", watch.seeds, "Number of seeds for techniques that draw random numbers; default: 8")
        ->check(CLI::Range(1, 1000));
    option(command, "--patience SECONDS", watch.patience,
           "Seconds without progress after which rendering is stopped, as in an endless loop")
        ->check(real_in(15, 1e6, "a number from 15, as there is a sign every ten seconds, to 1000000"))
        ->capture_default_str();
    option(command, "--out DIR", watch.out,
           "Folder of kept versions and rendered images; default: results/watch/<name>.<scene>");
    add_device(command, line.common), add_scene_path(command, line.common), add_cache(command, line.common);
    add_reading(command);
    command.callback([&] { watch_command(watch, run_options(command, line.common)); });
}
