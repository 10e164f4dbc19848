// The commands that render: run, gbuffer.
#include "core/error.h"
#include "core/gbuffer/gbuffer_transfer.h"
#include "core/gbuffer/rasterizer.h"
#include "core/gpu/device.h"
#include "core/scene/load_scene.h"
#include "experiments/commands/commands.h"
#include "experiments/study/config/shot.h"
#include "experiments/study/run.h"
#include "groundtruth/reference_cache.h"

#include <cstdio>

namespace {

Config config_of_study(const std::filesystem::path& file) {
    Config config = read_config(file);
    if (config.is_search) fail(file.string(), ": has a 'search': `ssrlab search` runs it");
    return config;
}

std::filesystem::path default_results(const std::filesystem::path& config) {
    return std::filesystem::path("results") / config.stem();
}

}  // namespace

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

void gbuffer_command(const GBufferCommandOptions& options, const CommonOptions& common) {
    const ShotConfig config{.scene = options.shot.scene,
                            .camera = options.shot.camera,
                            .extent = {options.shot.size[0], options.shot.size[1]},
                            .frames = {options.shot.frame}};
    const Shot shot = load_shot(config, scene_search_path(common.scene_path));
    for (const std::string& warning : shot.scene.warnings) std::fprintf(stderr, "warning: %s\n", warning.c_str());
    const DepthFormat format = options.depth_format == "d16"   ? DepthFormat::d16
                               : options.depth_format == "d24" ? DepthFormat::d24
                                                               : DepthFormat::d32f;

    Device device(common.device);
    Rasterizer rasterizer(device, shot.scene, {.extent = config.extent, .depth_format = format});
    const GBuffer gbuffer = rasterizer.render(
        shot.camera, {.extent = config.extent,
                      .depth_direction = options.is_reversed ? DepthDirection::reversed : DepthDirection::standard,
                      .frame = options.shot.frame});
    rasterizer.light_directly(gbuffer);
    const std::filesystem::path out =
        options.out.empty() ? std::filesystem::path(shot.scene.name + "_gbuffer") : options.out;
    save_gbuffer(out, download_gbuffer(rasterizer.graph(), gbuffer, rasterizer.camera(), format));
    std::printf("%s\n%s\n", (out / "gbuffer.exr").c_str(), (out / "camera.json").c_str());
}
