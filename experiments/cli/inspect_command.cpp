// ssrlab inspect: what is understood of a file.
#include "core/error.h"
#include "core/files.h"
#include "core/gpu/device.h"
#include "core/png.h"
#include "core/scene/load_scene.h"
#include "experiments/bridges/inspect/first_view_images.h"
#include "experiments/bridges/inspect/page.h"
#include "experiments/cli/commands.h"

#include <cstdio>

namespace {

struct InspectOptions {
    std::string file;               ///< or a folder, or a scene's name
    bool has_all = false;           ///< lists are not cut
    std::string scene;              ///< of an engine's frames; "": by the views' names
    std::filesystem::path json;     ///< "-": in place of the page; "": none
    std::filesystem::path picture;  ///< a PNG of the first view; "": none
};

/// Draws the first view by both renderers.
Description draw_first_view(const Scene& scene, const std::filesystem::path& file, const std::string& device_name) {
    Device device(device_name);
    const FirstView view = first_view(scene);
    const FirstViewImages rasterised = rasterised_first_view(device, scene, view),
                          traced = traced_first_view(scene, view);
    const FirstViewDifference difference = difference_of(rasterised, traced);
    write_png(file, picture_of(rasterised, traced, difference, scene.camera("").exposure_ev));
    Description entry = to_json(difference);
    entry["width"] = view.extent.x, entry["height"] = view.extent.y, entry["picture"] = file.string();
    return entry;
}

}  // namespace

static void inspect_command(const InspectOptions& options, const CommonOptions& common) {
    const Inspected inspected = inspect(options.file, scene_search_path(common.scene_path), options.scene);
    Description description = inspected.description;
    const bool prints_json = options.json == "-", writes_json = !options.json.empty() && !prints_json;
    if (!options.picture.empty() && inspected.refusal.empty() && !inspected.scene)
        fail("--picture draws a scene's first view, and ", options.file, " is no scene");
    if (!options.picture.empty() && inspected.scene)
        description["first_view"] = draw_first_view(*inspected.scene, options.picture, common.device);
    const auto json = [&] {
        return description.dump(2, ' ', /*ensure_ascii=*/true, Description::error_handler_t::replace) + "\n";
    };
    std::printf("%s", (prints_json ? json() : page_of(description, options.has_all)).c_str());
    std::fflush(stdout);  // before what is wrong
    if (!inspected.refusal.empty()) fail(inspected.refusal);
    if (writes_json) write_text(options.json, json());
}

void add_inspect(Commands& line) {
    InspectOptions& inspect = line.keep<InspectOptions>();
    CLI::App& command = line.add(
        "inspect", "Show what ssrlab understands of a file: a scene, an image, a capture or an engine's frames",
        "ssrlab inspect my_scene.glb");
    option(command, "file FILE", inspect.file,
           "A .gltf, .glb or scene.json file, the folder of one, the name of a scene, an image, or the folder of a "
           "capture or of an engine's frames")
        ->required();
    option(command, "--scene SCENE", inspect.scene,
           "Scene of an engine's frames: a name or a file, as for `ssrlab judge`; default: by the views' names");
    command.add_flag("--all", inspect.has_all, "Print lists in full; by default, the first eight entries of each");
    option(command, "--json FILE.json", inspect.json, "Also write everything as JSON; with - print only JSON");
    option(command, "--picture FILE.png", inspect.picture,
           "Also draw the first view of a scene by the rasteriser and by the path tracer, and where they differ");
    add_device(command, line.common), add_scene_path(command, line.common);
    add_reading(command);
    command.callback([&] { inspect_command(inspect, line.common); });
}
