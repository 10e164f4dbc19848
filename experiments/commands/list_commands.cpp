// The commands that list things: describe, list.
#include "core/error.h"
#include "core/files.h"
#include "core/gpu/chips/chip_compiler.h"
#include "core/gpu/device.h"
#include "core/json.h"
#include "core/near_miss.h"
#include "core/scene/load_scene.h"
#include "core/scene/scene_family.h"
#include "core/shown_text.h"
#include "experiments/commands/commands.h"
#include "experiments/config/config_schema.h"
#include "metrics/metric.h"
#include "metrics/temporal.h"
#include "variants/registry.h"
#include "variants/resolves/resolves.h"
#include "variants/tracers/tracers.h"

#include <algorithm>
#include <cstdio>
#include <iostream>
#include <set>
#include <sstream>

namespace {

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

/// But for those that the technique decides.
ParameterSet parameters_of(const ResolveEntry& resolve) {
    ParameterSet declared, params;
    resolve.declare(declared);
    for (const Parameter& p : declared)
        if (!std::ranges::count(resolve.given, p.name)) params.add(p);
    return params;
}

void describe_resolve(const ResolveEntry& resolve) {
    std::cout << resolve.name << ": " << resolve.title << "\n  " << resolve.description
              << "\n  Source: " << resolve.source << '\n';
    if (resolve.needs_density) std::cout << "  Needs the densities of rays, which mirror rays lack\n";
    std::cout << parameters_of(resolve).help();
}

/// Of a technique that has them.
void describe_resolves(const ParameterSet& params) {
    for (const ResolveEntry& resolve : resolve_table())
        if (const std::string help = params.help(resolve.name); !help.empty())
            std::cout << "\nParameters of the resolve " << resolve.name << ":\n" << help;
}

bool is_resolve(const std::string& name) { return std::ranges::count(resolve_table(), name, &ResolveEntry::name) > 0; }

bool is_tracer(const std::string& name) {
    return std::ranges::any_of(tracer_table(), [&](const TracerEntry& tracer) { return tracer.name == name; });
}

/// The text in indented lines of 100 columns at most, broken at spaces; a longer word stands alone.
std::string indented(const std::string& text, size_t indent) {
    constexpr size_t columns = 100;
    std::istringstream words(text);
    std::string lines, line;
    for (std::string word; words >> word;) {
        if (!line.empty() && indent + line.size() + 1 + word.size() > columns) {
            lines += std::string(indent, ' ') + line + '\n';
            line.clear();
        }
        line += (line.empty() ? "" : " ") + word;
    }
    return lines + std::string(indent, ' ') + line + '\n';
}

/// The first folder of the search path that has the scene, of which list_scenes() found one.
std::filesystem::path folder_of_scene(const std::string& name, const std::vector<std::filesystem::path>& search_path) {
    return *std::ranges::find_if(search_path, [&](const std::filesystem::path& folder) {
        return std::filesystem::exists(folder / name / "scene.json");
    }) / name;
}

/// What a scene tests: the line of about.txt beside its scene.json; "" where there is none.
std::string about_scene(const std::filesystem::path& folder) {
    const std::filesystem::path about = folder / "about.txt";
    const std::string text = std::filesystem::exists(about) ? read_text(about) : "";
    return text.substr(0, text.find('\n'));
}

/// "main, dolly": those that scene.json names, of which the first is the default; "" where the glTF's own are used,
/// which only loading it would tell, and of a malformed file, whose mistake loading it tells.
std::string cameras_of_scene(const std::filesystem::path& folder) try {
    const nlohmann::json scene = read_json(folder / "scene.json");
    std::string names;
    for (const nlohmann::json& camera : scene.value("cameras", nlohmann::json::array()))
        names += (names.empty() ? "" : ", ") + camera.value("name", "");
    return names;
} catch (const std::exception&) {
    return "";
}

void list_scenes_with_tests(const std::vector<std::filesystem::path>& search_path) {
    const std::vector<std::string> names = list_scenes(search_path);
    size_t width = 0;
    for (const std::string& name : names) width = std::max(width, name.size());
    for (const std::string& name : names) {
        const std::filesystem::path folder = folder_of_scene(name, search_path);
        const std::string about = about_scene(folder), cameras = cameras_of_scene(folder), indent(width + 2, ' ');
        std::cout << shown_text(name) << (about.empty() ? "" : indent.substr(name.size()) + shown_text(about)) << '\n';
        if (!cameras.empty()) std::cout << indent << "Cameras: " << shown_text(cameras) << '\n';
    }
    for (const SceneFamily& family : scene_families()) {
        const std::string range = family.name + ":0 to " + family.name + ":" + std::to_string(largest_scene_number);
        std::cout << range << std::string(range.size() < width ? width + 2 - range.size() : 2, ' ') << family.about
                  << '\n'
                  << std::string(width + 2, ' ') << "Cameras: main, path\n";
    }
}

void list_variants() {
    for (const VariantEntry& entry : variant_table())
        std::cout << entry.name << ": " << entry.title << '\n'
                  << indented(entry.description, 4) << indented("Source: " + entry.source, 4);
}

/// By the names that `--variants` of other commands take.
void list_presets() {
    for (const VariantEntry& entry : variant_table())
        for (const Preset& preset : entry.presets)
            std::cout << entry.name << ':' << preset.name << '\n' << indented(preset.meaning, 4);
}

}  // namespace

void describe_command(const DescribeOptions& asked) {
    DescribeOptions options = asked;
    options.variant = technique_name(asked.variant);
    if (options.as_schema) {
        std::cout << config_schema(options.variant).dump(2) << '\n';
        return;
    }
    if (!options.document.empty()) return write_text(options.document, with_key_tables(read_text(options.document)));
    if (is_tracer(options.variant)) {
        ParameterSet params;
        for (const TracerEntry& tracer : tracer_table())
            if (part_of(tracer) == part_of(find_tracer(options.variant))) tracer.create(params);
        return describe_tracer(find_tracer(options.variant), params);
    }
    if (is_resolve(options.variant)) return describe_resolve(find_resolve(options.variant));
    if (!options.variant.empty() && !std::ranges::count(variant_table(), options.variant, &VariantEntry::name)) {
        std::vector<std::string> names;
        for (const VariantEntry& entry : variant_table()) names.push_back(entry.name);
        for (const TracerEntry& tracer : tracer_table()) names.push_back(tracer.name);
        for (const ResolveEntry& resolve : resolve_table()) names.push_back(resolve.name);
        fail("unknown variant, tracer or resolve '", shortened(options.variant), "'",
             suggestion(options.variant, names));
    }
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
        describe_resolves(variant->params);
        if (!entry.presets.empty()) std::cout << "\nPresets:\n";
        for (const Preset& preset : entry.presets)
            std::cout << "  " << preset.name << ": " << preset.meaning << " " << preset.parameters.dump() << '\n';
        std::cout << '\n';
    }
}

void list_command(const std::string& what, const CommonOptions& common) {
    if (what == "scenes") list_scenes_with_tests(scene_search_path(common.scene_path));
    if (what == "variants") list_variants();
    if (what == "presets") list_presets();
    if (what == "tracers")
        for (const TracerEntry& tracer : tracer_table())
            std::printf("%-22s %s (%s)\n", tracer.name.c_str(), tracer.title.c_str(), tracer.source.c_str());
    if (what == "resolves")
        for (const ResolveEntry& resolve : resolve_table())
            std::printf("%-22s %s (%s)\n", resolve.name.c_str(), resolve.title.c_str(), resolve.source.c_str());
    if (what == "metrics") {
        const auto print = [](const auto& metric) {
            std::printf("%-25s %-26s %s\n", metric.name.c_str(), metric.formula.c_str(), metric.doc.c_str());
        };
        for (const Metric& metric : all_metrics()) print(metric);
        std::printf("\nOf shots that move or repeat a frame:\n");
        for (const TemporalMetric& metric : temporal_metrics()) print(metric);
    }
    if (what == "chips")
        for (const Chip& chip : known_chips()) std::printf("%-12s %s\n", chip.name.c_str(), chip.driver.c_str());
    if (what == "devices") {
        const std::vector<DeviceInfo> devices = list_devices();
        for (size_t i = 0; i < devices.size(); ++i)
            std::printf("%zu  %s (%s, %s, Vulkan %s)%s\n", i, devices[i].name.c_str(), devices[i].type.c_str(),
                        devices[i].driver.c_str(), devices[i].api.c_str(),
                        devices[i].has_hardware() ? "" : ": compiles shaders and runs none (RADV_FORCE_FAMILY is set)");
    }
}
