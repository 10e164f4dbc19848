// ssrlab shaders: what compilers of GPUs make of a technique's passes, without a GPU.
#include "core/cache_folder.h"
#include "core/error.h"
#include "core/files.h"
#include "core/gpu/device.h"
#include "core/list_text.h"
#include "core/number_text.h"
#include "core/path_inside.h"
#include "core/scene/load_scene.h"
#include "core/shown_text.h"
#include "experiments/cli/commands.h"
#include "experiments/gpu_costs/chips/chip_compiler.h"
#include "experiments/study/config/points/all_points.h"
#include "experiments/study/measuring/costs/compiled_shaders.h"
#include "experiments/study/needs.h"

#include <algorithm>
#include <cstdio>

namespace {

struct ShadersOptions {
    std::string technique, preset;
    nlohmann::json parameters = nlohmann::json::object();
    std::vector<std::string> chips;  ///< names that radv has for them
    std::filesystem::path mesa;      ///< a folder, see unpacked_mesa.h; "": the installed one
    std::string against;             ///< another preset, or a results folder; "": nothing
    ShotOptions shot;
    bool leaves_out = false;              ///< what the scene does not need
    std::filesystem::path assembly, csv;  ///< a folder, and a file; "": none
};

namespace fs = std::filesystem;

/// Two renderings of one pose, so that passes that only run with a history do.
Shot shot_of(const ShotOptions& options, const CommonOptions& common) {
    return load_shot({.scene = options.scene,
                      .camera = options.camera,
                      .has_planes_of_scene = options.has_planes_of_scene(),
                      .extent = {options.size[0], options.size[1]},
                      .frames = {options.frame},
                      .warm_up = 1,
                      .direct_lit = true},
                     scene_search_path(common.scene_path));
}

StagePipelines pipelines_of(Device& device, const Shot& shot, const PointConfig& point, bool leaves_out) {
    const std::unique_ptr<FrameSource> source = scene_source(device, shot, timed_config({point}, 0), !leaves_out);
    FrameStore store(*source, shot.config, 0);
    const HostImage unused;
    StagePipelines pipelines = stage_pipelines(
        device, shot, store, [&](const FrameStep&) -> const HostImage& { return unused; }, point, !leaves_out);
    if (pipelines.entries().empty())
        fail(point.technique, " ", point.point, " has no passes of its own that a GPU could run");
    return pipelines;
}

std::string text_of(const std::optional<double>& value) { return value ? fixed_text(*value) : "-"; }

std::string place_of(const CompiledRow& row) {
    return row.stage + (row.pipeline > 0 ? " #" + std::to_string(row.pipeline + 1) : "") +
           (row.shader == "vertex" ? " vertex" : "");
}

/// What differs from the same shader of another point or run; "only here" where that has none.
std::string change_from(const CompiledRow& row, const std::vector<CompiledRow>& others) {
    const auto other = std::ranges::find_if(others, [&](const CompiledRow& o) {
        return o.chip == row.chip && o.stage == row.stage && o.pipeline == row.pipeline && o.shader == row.shader;
    });
    if (other == others.end()) return "only here";
    if (!row.hash.empty() && row.hash == other->hash) return "same machine code";
    std::vector<std::string> changes;
    const auto add = [&](std::string name, const std::optional<double>& before, const std::optional<double>& now) {
        if (before != now) changes.push_back(name + ' ' + text_of(before) + " -> " + text_of(now));
    };
    add("VGPRs", other->vgprs, row.vgprs), add("spilled", other->spilled_vgprs, row.spilled_vgprs);
    add("waves", other->waves, row.waves), add("instructions", other->instructions, row.instructions);
    add("cycles", other->inverse_throughput, row.inverse_throughput);
    return changes.empty() ? "other machine code" : joined(changes);
}

void print(const std::vector<CompiledRow>& rows, const std::vector<CompiledRow>& others, const std::string& against) {
    std::printf("  %-44s %5s %5s %5s %7s %6s %9s %-16s %7s %8s %8s  %-8s%s\n", "", "lanes", "VGPRs", "SGPRs", "spilled",
                "LDS", "waves", "limited by", "instr.", "latency", "cycles", "code",
                against.empty() ? "" : ("  against " + against).c_str());
    for (const CompiledRow& row : rows) {
        if (row.shader == "vertex") continue;  // of the triangle over the image: in the CSV file alone
        if (!row.refusal.empty()) {
            std::printf("  %-44s %s\n", place_of(row).c_str(), shown_text(row.refusal).c_str());
            continue;
        }
        const std::string waves = text_of(row.waves) + (row.most_waves ? " of " + text_of(row.most_waves) : "");
        std::printf("  %-44s %5u %5s %5s %7s %6s %9s %-16s %7s %8s %8s  %-8s%s\n", place_of(row).c_str(), row.lanes,
                    text_of(row.vgprs).c_str(), text_of(row.sgprs).c_str(), text_of(row.spilled_vgprs).c_str(),
                    text_of(row.lds_bytes).c_str(), waves.c_str(), row.limit.c_str(), text_of(row.instructions).c_str(),
                    text_of(row.latency).c_str(), text_of(row.inverse_throughput).c_str(), row.hash.c_str(),
                    against.empty() ? "" : ("  " + change_from(row, others)).c_str());
    }
    for (const CompiledRow& other : others) {
        const bool is_here = std::ranges::any_of(rows, [&](const CompiledRow& row) {
            return row.stage == other.stage && row.pipeline == other.pipeline && row.shader == other.shader;
        });
        if (!is_here && other.shader != "vertex" && other.chip == rows.front().chip)
            std::printf("  %-44s only in %s\n", shown_text(place_of(other)).c_str(), shown_text(against).c_str());
    }
}

/// Rows of a study's compiled.csv, of the same point in its first shot that has it.
std::vector<CompiledRow> rows_of_folder(const fs::path& folder, const PointConfig& point) {
    std::vector<CompiledRow> rows = read_rows<CompiledRow>(folder / "compiled.csv");
    std::erase_if(rows, [&](const CompiledRow& r) { return r.technique != point.technique || r.point != point.point; });
    if (rows.empty()) fail((folder / "compiled.csv").string(), " has no ", point.technique, " ", point.point);
    const std::string shot = rows.front().shot;
    std::erase_if(rows, [&](const CompiledRow& r) { return r.shot != shot; });
    return rows;
}

void write_assembly(const fs::path& folder, const std::vector<CompiledRow>& rows,
                    const std::vector<std::string>& texts) {
    size_t next = 0;
    for (const CompiledRow& row : rows) {
        if (!row.refusal.empty()) continue;
        std::string name = row.stage + "." + std::to_string(row.pipeline) + "." + row.shader + "." + row.chip + ".s";
        std::ranges::replace(name, '/', '.');
        write_text(path_inside(folder, name), texts[next++]);
    }
    std::printf("Assembly: %s\n", shown_text(folder.string()).c_str());
}

}  // namespace

static void shaders_command(const ShadersOptions& options, const CommonOptions& common) {
    const PointConfig point = single_point(options.technique, options.preset, options.parameters);
    std::vector<Chip> chips;
    for (const std::string& name : options.chips) chips.push_back(find_chip(name, options.mesa));
    const Shot shot = shot_of(options.shot, common);
    Device device(common.device);
    const StagePipelines pipelines = pipelines_of(device, shot, point, options.leaves_out);

    const bool is_folder = !options.against.empty() && fs::is_directory(options.against);
    std::optional<PointConfig> other;
    std::vector<CompiledRow> others;
    StagePipelines other_pipelines;
    if (is_folder) {
        others = rows_of_folder(options.against, point);
    } else if (!options.against.empty()) {
        other = single_point(options.technique, options.against);
        other_pipelines = pipelines_of(device, shot, *other, options.leaves_out);
    }

    ChipCompilation how{
        .cache = common.cache.empty() ? default_cache_folder() : common.cache,
        .has_assembly = false,
        .notice = [](const std::string& text) { std::fprintf(stderr, "warning: %s\n", shown_text(text).c_str()); }};
    std::vector<CompiledRow> all;
    for (const Chip& chip : chips) {
        if (other)
            for (CompiledRow& row : compiled_rows(other_pipelines, shot.name(), *other, chip, how))
                others.push_back(std::move(row));
        how.has_assembly = !options.assembly.empty();
        std::vector<std::string> texts;
        const std::vector<CompiledRow> rows = compiled_rows(pipelines, shot.name(), point, chip, how, &texts);
        how.has_assembly = false;
        std::printf("%s%s %s on %s (%s)\n", all.empty() ? "" : "\n", point.technique.c_str(), point.point.c_str(),
                    chip.name.c_str(), chip.driver.c_str());
        const auto of_other_driver = std::ranges::find_if(
            others, [&](const CompiledRow& o) { return o.chip == chip.name && o.driver != chip.driver; });
        if (of_other_driver != others.end())
            std::printf("  note: %s is of %s, so that differences may be those of the compilers\n",
                        shown_text(options.against).c_str(), shown_text(of_other_driver->driver).c_str());
        print(rows, others, options.against);
        if (!options.assembly.empty()) write_assembly(options.assembly, rows, texts);
        all.insert(all.end(), rows.begin(), rows.end());
    }
    if (!options.csv.empty()) write_rows(options.csv, all);
    std::printf(
        "\nVGPRs, SGPRs: registers of a lane and of a wave; spilled: VGPRs kept in memory; LDS: bytes of a workgroup\n"
        "waves: that a SIMD holds at a time, of those that it could; fewer hide less of the time that memory takes\n"
        "latency, cycles: the compiler's estimate for a wave, until it ends and of the busiest unit, if loops run 8 "
        "times\n");
}

void add_shaders(Commands& line) {
    ShadersOptions& shaders =
        line.keep<ShadersOptions>({.shot = {.scene = "mirror_pillars", .camera = {}, .size = {96, 54}}});
    shaders.chips.assign(default_chips.begin(), default_chips.end());
    shaders.mesa = chosen_mesa();
    CLI::App& command = line.add(
        "shaders", "Show what a GPU's compiler makes of a technique's passes: registers, occupancy, instructions",
        "ssrlab shaders amd_sssr --chip navi21,gfx1100");
    option(command, "technique NAME", shaders.technique,
           "Technique (see: ssrlab list techniques), or its folder, written with a /")
        ->required();
    add_values(command, shaders.preset, shaders.parameters);
    option(command, "--chip NAME", shaders.chips,
           "GPUs, by Mesa's names (see: ssrlab list chips); default: navi21, gfx1100, vega10")
        ->delimiter(',');
    add_mesa(command, shaders.mesa);
    option(command, "--against PRESET|RESULTS", shaders.against,
           "Also show the differences from another preset, or from a study with \"gpu_compilers\"");
    option(command, "--assembly DIR", shaders.assembly, "Write the machine code of each shader into this folder");
    option(command, "--csv FILE.csv", shaders.csv, "Also write the table");
    CLI::Option* const scene = option(command, "--scene SCENE", shaders.shot.scene,
                                      "Leave out work that this scene does not need. By default, nothing is left out, "
                                      "and the scene is mirror_pillars");
    add_device(command, line.common), add_scene_path(command, line.common), add_cache(command, line.common);
    add_reading(command);
    command.callback([&, scene] {  // this pointer ends with this function, before the command runs
        shaders.leaves_out = scene->count() > 0;
        shaders_command(shaders, line.common);
    });
}
