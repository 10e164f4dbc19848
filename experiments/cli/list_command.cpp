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
#include "core/terminal.h"
#include "core/wrapped_text.h"
#include "experiments/cli/commands.h"
#include "experiments/cli/config_of_study.h"
#include "experiments/gpu_costs/chips/chip_compiler.h"
#include "experiments/gpu_costs/chips/chip_rates.h"
#include "metrics/metric.h"
#include "metrics/temporal.h"
#include "variants/denoisers/denoisers.h"
#include "variants/registry.h"
#include "variants/tracers/tracers.h"

#include <algorithm>
#include <functional>
#include <iomanip>
#include <iostream>
#include <set>
#include <sstream>

namespace {

/// The text in indented lines of the terminal's width, or of 100 columns.
std::string indented(const std::string& text, size_t indent) {
    return wrapped(text, indent, terminal_columns(stdout).value_or(100));
}

/// The name in a column of `width`, and what it means.
void list_entry(std::ostream& out, const std::string& name, int width, const std::string& about) {
    out << std::left << std::setw(width) << name << ' ' << about << '\n';
}

/// Tracers or denoisers.
template <class Entries>
void list_parts(std::ostream& out, const Entries& entries) {
    for (const auto& entry : entries) list_entry(out, entry.name, 22, entry.title + " (" + entry.source + ")");
}

template <class Metrics>
void list_metrics(std::ostream& out, const Metrics& metrics) {
    for (const auto& metric : metrics) {
        std::ostringstream about;
        about << std::left << std::setw(26) << metric.formula << ' ' << metric.doc;
        list_entry(out, metric.name, 25, about.str());
    }
}

void list_included_studies(std::ostream& out) {
    const nlohmann::ordered_json groups = included_studies();
    for (const auto& [group, studies] : groups.items()) {
        out << group << '\n';
        for (const auto& [name, study] : studies.items())
            out << "  " << name << '\n' << indented(study.at("question").template get<std::string>(), 6);
    }
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

void list_scenes_with_tests(std::ostream& out, const std::vector<std::filesystem::path>& search_path) {
    const std::vector<std::string> names = list_scenes(search_path);
    size_t width = 0;
    for (const std::string& name : names) width = std::max(width, name.size());
    for (const std::string& name : names) {
        const std::filesystem::path folder = folder_of_scene(name, search_path);
        const std::string about = about_scene(folder), cameras = cameras_of_scene(folder), indent(width + 2, ' ');
        out << shown_text(name) << (about.empty() ? "" : indent.substr(name.size()) + shown_text(about)) << '\n';
        if (!cameras.empty()) out << indent << "Cameras: " << shown_text(cameras) << '\n';
    }
    for (const SceneFamily& family : scene_families()) {
        const std::string range = family.name + ":0 to " + family.name + ":" + std::to_string(largest_scene_number);
        out << range << std::string(range.size() < width ? width + 2 - range.size() : 2, ' ') << family.about << '\n'
            << std::string(width + 2, ' ') << "Cameras: main, path\n";
    }
}

void list_techniques(std::ostream& out) {
    for (const TechniqueEntry& entry : technique_table())
        out << entry.name << ": " << entry.title << '\n'
            << indented(entry.description, 4) << indented("Source: " + entry.source, 4);
}

/// By the names that `--techniques` of other commands take.
void list_presets(std::ostream& out) {
    for (const TechniqueEntry& entry : technique_table())
        for (const Preset& preset : entry.presets)
            out << entry.name << ':' << preset.name << '\n' << indented(preset.meaning, 4);
}

void list_vulkan_devices(std::ostream& out) {
    const std::vector<DeviceInfo> devices = list_devices();
    for (size_t i = 0; i < devices.size(); ++i) {
        const DeviceInfo& device = devices[i];
        out << i << "  " << device.name << " (" << device.type << ", " << device.driver << ", Vulkan " << device.api
            << ')' << (device.has_hardware() ? "" : ": compiles shaders and runs none (RADV_FORCE_FAMILY is set)")
            << '\n';
    }
}

/// A topic of `ssrlab list`.
struct Topic {
    std::string name;
    std::function<void(std::ostream&)> list;
};

std::vector<Topic> topics(const std::filesystem::path& mesa, const CommonOptions& common) {
    return {{"scenes", [&](auto& out) { list_scenes_with_tests(out, scene_search_path(common.scene_path)); }},
            {"studies", list_included_studies},
            {"techniques", list_techniques},
            {"presets", list_presets},
            {"tracers", [](auto& out) { list_parts(out, tracer_table()); }},
            {"denoisers", [](auto& out) { list_parts(out, denoiser_table()); }},
            {"metrics",
             [](auto& out) {
                 list_metrics(out, all_metrics());
                 out << "\nOf shots that move or repeat a frame, where they are measured without being named:\n";
                 list_metrics(out, temporal_metrics());
             }},
            {"devices", list_vulkan_devices},
            {"chips", [&](auto& out) {
                 for (const Chip& chip : known_chips(mesa)) {
                     const auto rates = chip_rates(chip.name);
                     list_entry(out, chip.name, 12, (rates ? rates->product + ": " : "") + chip.driver);
                 }
             }}};
}

}  // namespace

static void list_command(const std::string& what, const std::filesystem::path& mesa, const CommonOptions& common) {
    std::ostringstream out;
    const std::vector<Topic> all = topics(mesa, common);
    find_named(all, what, "no list is called").list(out);
    std::cout << fitted(out.str(), terminal_columns(stdout));
}

void add_list(Commands& line) {
    auto& what = line.keep<std::string>();
    auto& mesa = line.keep<std::filesystem::path>(chosen_mesa());
    CLI::App& command = line.add("list",
                                 "List scenes and what each tests, included studies, techniques, presets, tracers, "
                                 "denoisers, metrics, devices or "
                                 "chips",
                                 "ssrlab list scenes");
    option(command, "what WHAT", what, "What to list")
        ->required()
        ->check(name_among(names_of(topics(mesa, line.common), &Topic::name)));
    add_mesa(command, mesa);
    add_scene_path(command, line.common);
    add_reading(command);
    command.callback([&] { list_command(what, mesa, line.common); });
}
