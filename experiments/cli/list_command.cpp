// ssrlab list: what there is.
#include "core/error.h"
#include "core/files.h"
#include "core/gpu/device.h"
#include "core/json.h"
#include "core/list_text.h"
#include "core/near_miss.h"
#include "core/scene/load_scene.h"
#include "core/scene/scene_family.h"
#include "core/shown_text.h"
#include "experiments/cli/commands.h"
#include "experiments/gpu_costs/chips/chip_compiler.h"
#include "metrics/metric.h"
#include "metrics/temporal.h"
#include "variants/denoisers/denoisers.h"
#include "variants/registry.h"
#include "variants/tracers/tracers.h"

#include <algorithm>
#include <cstdio>
#include <iostream>
#include <set>
#include <sstream>

namespace {

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
    return joined(names_of(scene.value("cameras", nlohmann::json::array()),
                           [](const nlohmann::json& camera) { return camera.value("name", ""); }));
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

void list_techniques() {
    for (const TechniqueEntry& entry : technique_table())
        std::cout << entry.name << ": " << entry.title << '\n'
                  << indented(entry.description, 4) << indented("Source: " + entry.source, 4);
}

/// By the names that `--techniques` of other commands take.
void list_presets() {
    for (const TechniqueEntry& entry : technique_table())
        for (const Preset& preset : entry.presets)
            std::cout << entry.name << ':' << preset.name << '\n' << indented(preset.meaning, 4);
}

}  // namespace

static void list_command(const std::string& what, const std::filesystem::path& mesa, const CommonOptions& common) {
    if (what == "scenes") list_scenes_with_tests(scene_search_path(common.scene_path));
    if (what == "techniques") list_techniques();
    if (what == "presets") list_presets();
    if (what == "tracers")
        for (const TracerEntry& tracer : tracer_table())
            std::printf("%-22s %s (%s)\n", tracer.name.c_str(), tracer.title.c_str(), tracer.source.c_str());
    if (what == "denoisers")
        for (const DenoiserEntry& denoiser : denoiser_table())
            std::printf("%-22s %s (%s)\n", denoiser.name.c_str(), denoiser.title.c_str(), denoiser.source.c_str());
    if (what == "metrics") {
        const auto print = [](const auto& metric) {
            std::printf("%-25s %-26s %s\n", metric.name.c_str(), metric.formula.c_str(), metric.doc.c_str());
        };
        for (const Metric& metric : all_metrics()) print(metric);
        std::printf("\nOf shots that move or repeat a frame:\n");
        for (const TemporalMetric& metric : temporal_metrics()) print(metric);
    }
    if (what == "chips")
        for (const Chip& chip : known_chips(mesa)) std::printf("%-12s %s\n", chip.name.c_str(), chip.driver.c_str());
    if (what == "devices") {
        const std::vector<DeviceInfo> devices = list_devices();
        for (size_t i = 0; i < devices.size(); ++i)
            std::printf("%zu  %s (%s, %s, Vulkan %s)%s\n", i, devices[i].name.c_str(), devices[i].type.c_str(),
                        devices[i].driver.c_str(), devices[i].api.c_str(),
                        devices[i].has_hardware() ? "" : ": compiles shaders and runs none (RADV_FORCE_FAMILY is set)");
    }
}

void add_list(Commands& line) {
    auto& what = line.keep<std::string>();
    auto& mesa = line.keep<std::filesystem::path>(chosen_mesa());
    CLI::App& command = line.add(
        "list", "List scenes and what each tests, techniques, presets, tracers, denoisers, metrics, devices or chips");
    option(command, "what scenes|techniques|presets|tracers|denoisers|metrics|devices|chips", what, "What to list")
        ->required()
        ->check(
            CLI::IsMember({"scenes", "techniques", "presets", "tracers", "denoisers", "metrics", "devices", "chips"}));
    add_mesa(command, mesa);
    add_scene_path(command, line.common);
    add_reading(command);
    command.callback([&] { list_command(what, mesa, line.common); });
}
