// The commands of studies and of what they can be made from: run, merge, report, gbuffer, capture.
#include "core/cache_folder.h"
#include "core/error.h"
#include "core/gbuffer/gbuffer_transfer.h"
#include "core/gbuffer/rasterizer.h"
#include "core/gpu/device.h"
#include "core/scene/load_scene.h"
#include "core/shown_text.h"
#include "experiments/commands/commands.h"
#include "experiments/config/shots/scene_warnings.h"
#include "experiments/config/shots/shot.h"
#include "experiments/evaluation/columns/table_columns.h"
#include "experiments/measuring/frames/capture.h"
#include "experiments/report/report.h"
#include "experiments/run/run.h"

#include <cstdio>

Config config_of_study(const std::filesystem::path& file) {
    Config config = read_config(file);
    if (config.is_tuned) fail(file.string(), ": has a 'tune': `ssrlab tune` runs it");
    check_table_columns(config);
    return config;
}

std::filesystem::path default_results(const std::filesystem::path& config) {
    return std::filesystem::path("results") / config.stem();
}

void run_study_command(const RunOptions& options, const CommonOptions& common) {
    run_study(config_of_study(options.config),
              {.out = options.out.empty() ? default_results(options.config) : options.out,
               .device = common.device,
               .cache = common.cache.empty() ? default_cache_folder() : common.cache,
               .search_path = scene_search_path(common.scene_path),
               .keep_all = options.keep_all,
               .replaces = options.replaces,
               .prunes = options.prunes,
               .takes_times_here = options.takes_times_here,
               .takes_times_again = options.takes_times_again,
               .report_after = options.report_after,
               .has_report = !options.has_no_report,
               .cells = options.cells});
}

int merge_command(const MergeOptions& options, const CommonOptions& common) {
    const std::filesystem::path out = options.out.empty() ? default_results(options.config) : options.out;
    const size_t missing = merge_study(config_of_study(options.config),
                                       {.out = out,
                                        .device = common.device,
                                        .search_path = scene_search_path(common.scene_path),
                                        .keep_all = options.keep_all,
                                        .replaces = options.replaces},
                                       options.folders.empty() ? std::vector{out} : options.folders);
    return missing > 0 ? 1 : 0;
}

void report_command(const std::filesystem::path& folder, bool links_images) {
    write_report(folder, links_images);
    std::printf("Report: %s\n", std::filesystem::absolute(folder / "report.html").lexically_normal().c_str());
}

void gbuffer_command(const GBufferCommandOptions& options, const CommonOptions& common) {
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
        const std::filesystem::path folder = options.frames.empty() ? out : out / name;
        HostGBuffer host = download_gbuffer(rasterizer.graph(), gbuffer, rasterizer.camera(), format);
        host.exposure_ev = shot.camera.exposure_ev;
        save_gbuffer(folder, host);
        std::printf("%s\n%s\n", (folder / "gbuffer.exr").c_str(), (folder / "camera.json").c_str());
    }
    save_environment(out, shot.scene.environment);
    std::printf("%s\n", (out / "environment.json").c_str());
}

void capture_command(const CaptureCommandOptions& options) {
    Capture capture(options.folder);
    const ShotConfig config{.frames = capture.frames(), .gbuffer = options.folder};
    const Shot shot = capture_shot(config, capture);
    const CaptureContents contents = inspect_capture(shot, capture);
    std::printf("%s: %zu frame%s of %ux%u, %s lit colour, %s\n", shown_text(shot.scene.name).c_str(),
                config.frames.size(), config.frames.size() == 1 ? "" : "s", shot.config.extent.x, shot.config.extent.y,
                contents.has_lit ? "with a" : "without a",
                capture.environment() ? "with an environment" : "without an environment");
    std::printf("layers:");
    for (const std::string& layer : contents.layers) std::printf(" %s", layer.c_str());
    std::printf("\n");
    const unsigned last = config.frames.back();
    const bool has_before = config.frames.size() > 1;
    std::printf("frame %u:\n", last);
    for (const SceneFact& fact : list_facts(
             pixel_facts(capture.played(last, has_before ? std::optional(last - 1) : std::optional<unsigned>()))))
        std::printf("  %-18s %-10s %s\n", fact.name.c_str(), fact.value.c_str(), fact.why.c_str());
    for (const std::string& note : contents.notes) std::printf("note: %s\n", shown_text(note).c_str());
}
