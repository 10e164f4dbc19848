// ssrlab gbuffer: a scene's G-buffer as files.
#include "core/error.h"
#include "core/gbuffer/gbuffer_transfer.h"
#include "core/gbuffer/rasterizer.h"
#include "core/gpu/device.h"
#include "core/path_inside.h"
#include "core/png.h"
#include "core/scene/load_scene.h"
#include "core/shown_text.h"
#include "experiments/cli/commands.h"
#include "experiments/cli/gbuffer_sheet.h"
#include "experiments/study/config/shots/scene_warnings.h"
#include "experiments/study/config/shots/shot.h"

#include <cstdio>

namespace {

struct GBufferCommandOptions {
    ShotOptions shot;
    std::vector<unsigned> frames;  ///< first and last, each into a folder of its own; empty: shot.frame alone
    std::filesystem::path out;
    std::string depth_format = "d32f";
    bool is_reversed = false;
};

}  // namespace

static void gbuffer_command(const GBufferCommandOptions& options, const CommonOptions& common) {
    const unsigned first = options.frames.empty() ? options.shot.frame : options.frames.front(),
                   last = options.frames.empty() ? first : options.frames.back();
    if (last < first) fail("--frames: ", first, " to ", last, " runs backwards");
    const DepthFormat format = options.depth_format == "d16"   ? DepthFormat::d16
                               : options.depth_format == "d24" ? DepthFormat::d24
                                                               : DepthFormat::d32f;
    const ShotConfig config{
        .scene = options.shot.scene,
        .choices = {.animation = options.shot.animation},
        .camera = options.shot.camera,
        .has_planes_of_scene = options.shot.has_planes_of_scene(),
        .extent = {options.shot.size[0], options.shot.size[1]},
        .frames = {first},
        .depth_format = format,
        .depth_direction = options.is_reversed ? DepthDirection::reversed : DepthDirection::standard};
    const Shot shot = load_shot(config, scene_search_path(common.scene_path));
    for (const std::string& warning : warning_sentences(shot.scene))
        std::fprintf(stderr, "warning: %s\n", shown_text(warning).c_str());
    const std::filesystem::path out =
        options.out.empty() ? std::filesystem::path(shot.scene.name + "_gbuffer") : options.out;

    Device device(common.device);
    Rasterizer rasterizer(device, shot.scene, {.extent = config.extent, .depth_format = format});
    for (unsigned frame = first; frame <= last; ++frame) {
        const GBuffer gbuffer = rasterizer.render(
            shot.camera, {.extent = config.extent, .depth_direction = config.depth_direction, .frame = frame});
        rasterizer.light_directly(gbuffer);
        char name[32];
        std::snprintf(name, sizeof name, "frame_%04u", frame);
        const std::filesystem::path folder = options.frames.empty() ? out : path_inside(out, name);
        HostGBuffer host = download_gbuffer(rasterizer.pass_list(), gbuffer, rasterizer.camera(), format);
        host.exposure_ev = shot.camera.exposure_ev;
        save_gbuffer(folder, host);
        write_png(folder / "gbuffer.png", gbuffer_sheet(host));
        for (const std::filesystem::path& file :
             {folder / "gbuffer.exr", folder / "gbuffer.png", folder / "camera.json"})
            std::printf("%s\n", shown_text(file.string()).c_str());
    }
    save_environment(out, shot.scene.environment);
    std::printf("%s\n", shown_text((out / "environment.json").string()).c_str());
}

void add_gbuffer(Commands& line) {
    GBufferCommandOptions& gbuffer = line.keep<GBufferCommandOptions>();
    CLI::App& command = line.add(
        "gbuffer", "Rasterise a scene's G-buffer into gbuffer.exr and camera.json, with pictures of it in gbuffer.png",
        "ssrlab gbuffer fence --out my_capture");
    add_shot(command, gbuffer.shot);
    option(command, "--frames A B", gbuffer.frames, "First and last frame of a sequence, both included")
        ->expected(2)
        ->excludes("--frame");
    option(command, "--out DIR", gbuffer.out, "Output folder; default: <scene>_gbuffer");
    option(command, "--depth-format", gbuffer.depth_format, "Format of the depth buffer")
        ->check(name_among({"d32f", "d24", "d16"}))
        ->capture_default_str();
    command.add_flag("--reversed-depth", gbuffer.is_reversed,
                     "Store depth as 1 at the near plane and 0 at the far plane");
    add_device(command, line.common), add_scene_path(command, line.common);
    add_reading(command);
    command.callback([&] { gbuffer_command(gbuffer, line.common); });
}
