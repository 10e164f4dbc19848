#include "experiments/cli/command_line.h"

#include "core/error.h"
#include "core/near_miss.h"
#include "core/reading_limits.h"

#include <algorithm>
#include <cstdlib>
#include <limits>

namespace {

/// {NAME: VALUE} of texts NAME=VALUE, whose values are JSON or else texts.
nlohmann::json parameters_of(const std::vector<std::string>& values) {
    nlohmann::json parameters = nlohmann::json::object();
    for (const std::string& text : values) {
        const size_t equals = text.find('=');
        if (equals == std::string::npos || equals == 0) fail("'", shortened(text), "' must be NAME=VALUE");
        const std::string value = text.substr(equals + 1);
        nlohmann::json json = nlohmann::json::parse(value, nullptr, false);
        parameters[text.substr(0, equals)] = json.is_discarded() ? nlohmann::json(value) : json;
    }
    return parameters;
}

}  // namespace

CLI::Validator real_in(double min, double max, const std::string& description) {
    return CLI::Validator(
        [=](std::string& text) {
            char* end = nullptr;
            const double value = std::strtod(text.c_str(), &end);
            const bool fits = !text.empty() && *end == 0 && value >= min && value <= max;
            return fits ? std::string() : "'" + text + "' must be " + description;
        },
        "");
}

const CLI::Validator& no_option_name() {
    static const CLI::Validator validator(
        [](std::string& word) {
            return word.starts_with("--")
                       ? "'" + word + "' is an option; for a file of this name write './" + word + "'"
                       : std::string();
        },
        "");
    return validator;
}

CLI::Validator positive() {
    return real_in(std::numeric_limits<double>::min(), std::numeric_limits<double>::max(), "a number above 0");
}

CLI::Validator name_among(const std::vector<std::string>& names) {
    return CLI::Validator(
        [=](std::string& text) {
            return std::ranges::count(names, text) ? std::string()
                                                   : "'" + shortened(text) + "' is not known" + suggestion(text, names);
        },
        "{" + joined(names, ",") + "}");
}

void add_margin(CLI::App& command, double& margin, const std::string& otherwise) {
    option(command, "--margin SHARE", margin,
           "Two errors are equivalent if they certainly differ by a smaller share than this; default: " + otherwise)
        ->check(CLI::Range(0.001, 1.0));
}

void add_reading(CLI::App& command) {
    command
        .add_option_function<uint64_t>(
            "--max-memory", [](const uint64_t& bytes) { reading_limits().memory = bytes; },
            "Memory that reading a file, or a technique's images and buffers, may take, for example 8GB. What "
            "announces "
            "more is refused. Default: "
            "SSRLAB_MAX_MEMORY, else half of this machine's memory")
        ->transform(CLI::AsSizeValue(true).description(""))
        ->transform(CLI::Validator(  // the last one comes first: CLI11 would take -1 for 2^64 - 1
            [](std::string& text) { return text.starts_with('-') ? "'" + text + "' must be a size" : std::string(); },
            ""))
        ->type_name("SIZE")
        ->envname("SSRLAB_MAX_MEMORY");
    command.add_flag_callback(
        "--allow-outside", [] { reading_limits().allows_outside = true; },
        "Allow scene and glTF files to name files outside their own folder. Use it only for files that you trust");
}

void add_scene_path(CLI::App& command, CommonOptions& common) {
    option(command, "--scene-path DIR", common.scene_path,
           "Folder with scenes, searched before SSRLAB_SCENE_PATH and ssrlab's own scenes; may be repeated");
}

void add_device(CLI::App& command, CommonOptions& common) {
    option(command, "--device NAME", common.device,
           "Vulkan device, by index or by part of its name (see: ssrlab list devices); default: a discrete GPU, else "
           "lavapipe");
}

void add_cache(CLI::App& command, CommonOptions& common) {
    option(command, "--cache DIR", common.cache,
           "Folder that caches references; default: SSRLAB_CACHE, else ssrlab in the user's cache folder");
}

void add_mesa(CLI::App& command, std::filesystem::path& mesa) {
    option(command, "--mesa FOLDER", mesa,
           "Folder of an unpacked Mesa whose driver compiles, as experiments/newer_mesa.sh makes it; default: "
           "SSRLAB_MESA, else the installed Mesa");
}

void add_config(CLI::App& command, std::filesystem::path& config, const std::string& more) {
    option(command, "config CONFIG", config,
           "The study: a .json file (`experiments/docs/reference/study_keys.md` explains the keys), or the name of an "
           "included study (see: ssrlab list studies)" +
               more)
        ->required();
}

void add_scene(CLI::App& command, std::string& scene) {
    option(command, "scene SCENE", scene,
           "Name of a scene (see: ssrlab list scenes), or path to a .json, .gltf or .glb file")
        ->required();
}

void add_size(CLI::App& command, std::vector<unsigned>& size, const std::string& otherwise) {
    option(command, "--size W H", size, "Width and height in pixels; default: " + otherwise)
        ->expected(2)
        ->check(CLI::Range(1, 16384));
}

void add_planes(CLI::App& command, ShotOptions& shot) {
    option(command, "--planes WHOSE", shot.planes,
           "Near and far planes. camera: those of the camera. scene: derived from the scene so that they cut nothing. "
           "Default: camera")
        ->check(name_among({"camera", "scene"}));
}

void add_animation(CLI::App& command, std::string& animation) {
    option(command, "--animation NAME", animation,
           "Animation of the glTF to play, by name, or all, or none; default: what scene.json says, else the first");
}

void add_shot(CLI::App& command, ShotOptions& shot) {
    add_scene(command, shot.scene), add_animation(command, shot.animation);
    option(command, "--camera NAME", shot.camera, "Camera of the scene, by name; default: the first");
    add_planes(command, shot);
    add_size(command, shot.size);
    option(command, "--frame N", shot.frame, "Frame of the camera's path and of the animation; default: 0");
}

std::vector<std::string> run_options(const CLI::App& command, const CommonOptions& common) {
    std::vector<std::string> options;
    if (command.count("--max-memory")) options.push_back("--max-memory=" + std::to_string(reading_limits().memory));
    if (reading_limits().allows_outside) options.push_back("--allow-outside");
    if (!common.device.empty()) options.push_back("--device=" + common.device);
    if (!common.cache.empty()) options.push_back("--cache=" + common.cache.string());
    for (const std::filesystem::path& folder : common.scene_path) options.push_back("--scene-path=" + folder.string());
    return options;
}

void add_values(CLI::App& command, std::string& preset, nlohmann::json& parameters) {
    option(command, "--preset NAME", preset,
           "Preset of the technique to start from; default: the technique's default parameters");
    command
        .add_option_function<std::vector<std::string>>(
            "--set", [&parameters](const std::vector<std::string>& values) { parameters = parameters_of(values); },
            "Value of a parameter; may be repeated")
        ->type_name("NAME=VALUE");
}

void refuse_unknown_command(const CLI::App& app, const std::string& name) {
    std::vector<std::string> names;
    for (const CLI::App* command : app.get_subcommands({})) {
        if (command->get_name() == name) return;
        if (!command->get_group().empty()) names.push_back(command->get_name());
    }
    const std::string near = nearest_name(name, names);
    fail("unknown command '", shortened(name), "'", suggestion(name, names),
         near.empty() ? "; `ssrlab help` explains them" : "");
}
