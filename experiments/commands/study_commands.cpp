// The commands around variants and devices: run, gbuffer, describe, list.
#include "core/error.h"
#include "core/gbuffer/gbuffer_transfer.h"
#include "core/gbuffer/rasterizer.h"
#include "core/gpu/device.h"
#include "core/scene/load_scene.h"
#include "experiments/commands/commands.h"
#include "experiments/study/config/config_schema.h"
#include "experiments/study/config/shot.h"
#include "experiments/study/run.h"
#include "groundtruth/reference_cache.h"
#include "metrics/metric.h"
#include "metrics/temporal.h"
#include "variants/registry.h"
#include "variants/tracers/tracers.h"

#include <algorithm>
#include <cstdio>
#include <iostream>
#include <set>

void run_study_command(const RunOptions& options, const CommonOptions& common) {
    const Config config = read_config(options.config);
    if (config.is_search) fail(options.config.string(), ": has a 'search': `ssrlab search` runs it");
    run_study(config,
              {.out = options.out.empty() ? std::filesystem::path("results") / options.config.stem() : options.out,
               .device = common.device,
               .cache = common.cache.empty() ? default_cache_folder() : common.cache,
               .search_path = scene_search_path(common.scene_path),
               .keep_all = options.keep_all,
               .replaces = options.replaces,
               .prunes = options.prunes});
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

std::string part_of(const TracerEntry& tracer) { return tracer.part.empty() ? tracer.name : tracer.part; }

void describe_tracer(const TracerEntry& tracer, const ParameterSet& params) {
    std::cout << tracer.name << ": " << tracer.title << "\n  " << tracer.description << "\n  Source: " << tracer.source
              << '\n';
    if (!tracer.fits_webgl2) std::cout << "  Does not fit WebGL 2\n";
    std::cout << params.help(part_of(tracer));
}

/// The tracers that a technique may use, each with its parameters, those of a shared part once.
void describe_tracers(const ParameterSet& params) {
    std::set<std::string> described;
    for (const TracerEntry& tracer : tracer_table()) {
        if (!described.insert(part_of(tracer)).second || params.help(part_of(tracer)).empty()) continue;
        std::cout << "\nParameters of the tracer " << tracer.name << ":\n" << params.help(part_of(tracer));
    }
}

bool is_tracer(const std::string& name) {
    return std::ranges::any_of(tracer_table(), [&](const TracerEntry& tracer) { return tracer.name == name; });
}

void describe_command(const DescribeOptions& options) {
    if (options.as_schema) {
        std::cout << config_schema(options.variant).dump(2) << '\n';
        return;
    }
    if (is_tracer(options.variant)) {
        ParameterSet params;
        for (const TracerEntry& tracer : tracer_table())
            if (part_of(tracer) == part_of(find_tracer(options.variant))) tracer.create(params);
        return describe_tracer(find_tracer(options.variant), params);
    }
    if (!options.variant.empty()) find_variant(options.variant);
    for (const VariantEntry& entry : variant_table()) {
        if (!options.variant.empty() && entry.name != options.variant) continue;
        std::cout << entry.name << ": " << entry.title << "\n  " << entry.description << "\n  Source: " << entry.source
                  << "\n";
        if (const std::string limits = limits_text(entry.limits); !limits.empty())
            std::cout << "  Enforced limits: " << limits << '\n';
        const std::unique_ptr<Variant> variant = make_variant(entry.name);
        const std::string parameters = variant->params.help();
        std::cout << (parameters.empty() ? "\nIt has no parameters.\n" : "\nParameters:\n" + parameters);
        describe_tracers(variant->params);
        if (!entry.presets.empty()) std::cout << "\nPresets:\n";
        for (const Preset& preset : entry.presets)
            std::cout << "  " << preset.name << ": " << preset.meaning << " " << preset.parameters.dump() << '\n';
        std::cout << '\n';
    }
}

void list_command(const std::string& what, const CommonOptions& common) {
    if (what == "scenes")
        for (const std::string& name : list_scenes(scene_search_path(common.scene_path)))
            std::printf("%s\n", name.c_str());
    if (what == "variants")
        for (const VariantEntry& entry : variant_table())
            std::printf("%-16s %s (%s)\n", entry.name.c_str(), entry.title.c_str(), entry.source.c_str());
    if (what == "tracers")
        for (const TracerEntry& tracer : tracer_table())
            std::printf("%-22s %s (%s)\n", tracer.name.c_str(), tracer.title.c_str(), tracer.source.c_str());
    if (what == "metrics") {
        const auto print = [](const auto& metric) {
            std::printf("%-25s %-26s %s\n", metric.name.c_str(), metric.formula.c_str(), metric.doc.c_str());
        };
        for (const Metric& metric : all_metrics()) print(metric);
        std::printf("\nOf shots that move or repeat a frame:\n");
        for (const TemporalMetric& metric : temporal_metrics()) print(metric);
    }
    if (what == "devices") {
        const std::vector<DeviceInfo> devices = list_devices();
        for (size_t i = 0; i < devices.size(); ++i)
            std::printf("%zu  %s (%s, %s, Vulkan %s)\n", i, devices[i].name.c_str(), devices[i].type.c_str(),
                        devices[i].driver.c_str(), devices[i].api.c_str());
    }
}
