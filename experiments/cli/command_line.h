#pragma once
#include "experiments/study/ended_point.h"

#include <CLI/CLI.hpp>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <type_traits>
#include <vector>

/// Options that most commands share.
struct CommonOptions {
    std::vector<std::filesystem::path> scene_path;
    std::string device;           ///< "": the default one
    std::filesystem::path cache;  ///< "": the default folder
};

/// The command line of `ssrlab`; each command adds itself (commands.h).
struct Commands {
    explicit Commands(CLI::App& app) : app(app) {}

    CLI::App& app;
    std::string group;  ///< under which help lists the commands that are added next
    int status = 0;     ///< exit code, set by the command that ran
    CommonOptions common;
    std::vector<EndedPoint> ended;  ///< points that ended this command before

    /// `example`: a command line that works, which help shows first.
    CLI::App& add(const std::string& name, const std::string& about, const std::string& example) {
        return *app.add_subcommand(name, about)->group(group)->footer(example);
    }

    /// Storage for a command's options; lives until the command has run.
    template <class Options>
    Options& keep(Options options = {}) {
        auto kept = std::make_shared<Options>(std::move(options));
        kept_.push_back(kept);
        return *kept;
    }

private:
    std::vector<std::shared_ptr<void>> kept_;
};

/// One frame of one camera.
struct ShotOptions {
    std::string scene, camera;
    std::string planes = "camera";  ///< or "scene": derive_planes()
    std::vector<unsigned> size{480, 270};
    unsigned frame = 0;
    std::string animation;  ///< "": the scene's

    bool has_planes_of_scene() const { return planes == "scene"; }
};

/// Refuses the name of an option where a text or a path is expected: `--out --help` would make a folder of this name.
const CLI::Validator& no_option_name();

/// Adds an option or positional argument by its name and the name of its value: "--out DIR", "scene SCENE", "--size W
/// H".
template <class Value>
CLI::Option* option(CLI::App& command, const std::string& name_and_type, Value& value, const std::string& help) {
    const size_t space = name_and_type.find(' ');
    CLI::Option* const added = command.add_option(name_and_type.substr(0, space), value, help);
    if constexpr (!std::is_arithmetic_v<Value>) added->check(no_option_name());
    return space == std::string::npos ? added : added->type_name(name_and_type.substr(space + 1));
}

// Checks of values, and options of several commands.

/// A range that excludes NaN, which CLI11's own ranges accept.
CLI::Validator real_in(double min, double max, const std::string& description);
CLI::Validator positive();
/// One of the names, else the nearest is suggested.
CLI::Validator name_among(const std::vector<std::string>& names);

/// Options that limit what files may cost and name, for all commands that read files (core/reading_limits.h).
void add_reading(CLI::App& command);
void add_scene_path(CLI::App& command, CommonOptions& common);
void add_device(CLI::App& command, CommonOptions& common);
void add_cache(CLI::App& command, CommonOptions& common);
void add_mesa(CLI::App& command, std::filesystem::path& mesa);
/// The margin of equivalence: PrimaryComparisons::margin.
void add_margin(CLI::App& command, double& margin, const std::string& otherwise);

/// A study; `more`: what else the help text says of it.
void add_config(CLI::App& command, std::filesystem::path& config, const std::string& more = "");
void add_scene(CLI::App& command, std::string& scene);
/// Width and height; `otherwise`: the default, for the help text.
void add_size(CLI::App& command, std::vector<unsigned>& size, const std::string& otherwise = "480 270");
void add_planes(CLI::App& command, ShotOptions& shot);
void add_animation(CLI::App& command, std::string& animation);
/// All of ShotOptions.
void add_shot(CLI::App& command, ShotOptions& shot);
/// A technique's preset, and parameter values that override the preset's or the defaults.
void add_values(CLI::App& command, std::string& preset, nlohmann::json& parameters);

/// The arguments for `ssrlab run` of a study that `command` makes.
std::vector<std::string> run_options(const CLI::App& command, const CommonOptions& common);

/// Fails with Error if `name` is not a command, and suggests the nearest. CLI11 would only say that a command is
/// missing.
void refuse_unknown_command(const CLI::App& app, const std::string& name);
