// The command line. Over 400 lines: the options of all commands, so that one place says what each takes.
#include "core/error.h"
#include "core/gpu/chips/chip_compiler.h"
#include "core/gpu/pipelines/shader_error.h"
#include "core/near_miss.h"
#include "core/reading_limits.h"
#include "core/scene/scene_family.h"
#include "core/shown_text.h"
#include "experiments/commands/commands.h"
#include "experiments/inspect/inspect_hint.h"
#include "experiments/store/host_info.h"
#include "metrics/tone_map.h"

#include <CLI/CLI.hpp>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <new>
#include <string_view>

namespace {

/// CLI11's own ranges let NaN pass, which lies in none.
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
CLI::Validator positive() {
    return real_in(std::numeric_limits<double>::min(), std::numeric_limits<double>::max(), "a number above 0");
}

/// What files may cost and name, of all commands that read them (core/reading_limits.h).
/// Of equivalence: PrimaryComparisons::margin.
void add_margin(CLI::App& command, double& margin, const std::string& otherwise) {
    command
        .add_option("--margin", margin,
                    "Errors that differ by a smaller share than this for certain are equivalent; default: " + otherwise)
        ->type_name("SHARE")
        ->check(CLI::Range(0.001, 1.0));
}

void add_reading(CLI::App& command) {
    command
        .add_option_function<uint64_t>(
            "--max-memory", [](const uint64_t& bytes) { reading_limits().memory = bytes; },
            "What files may take at one time, e.g. 8GB; more is refused before it is taken; default: "
            "SSRLAB_MAX_MEMORY, "
            "else half of this machine's")
        ->transform(CLI::AsSizeValue(true))
        ->transform(CLI::Validator(  // the last one comes first: CLI11 would take -1 for 2^64 - 1
            [](std::string& text) { return text.starts_with('-') ? "'" + text + "' must be a size" : std::string(); },
            ""))
        ->envname("SSRLAB_MAX_MEMORY");
    command.add_flag_callback(
        "--allow-outside", [] { reading_limits().allows_outside = true; },
        "Scene and glTF files may name files outside of their own folder; for files that you trust");
}

/// Options that most commands share.
void add_scene_path(CLI::App& command, CommonOptions& common) {
    command
        .add_option("--scene-path", common.scene_path,
                    "Folder with scenes, searched before SSRLAB_SCENE_PATH and ssrlab's own; may be repeated")
        ->type_name("DIR");
}

void add_device(CLI::App& command, CommonOptions& common) {
    command
        .add_option("--device", common.device,
                    "Vulkan device: its index or a part of its name (see: ssrlab list devices); default: a discrete "
                    "GPU, else lavapipe")
        ->type_name("NAME");
}

void add_cache(CLI::App& command, CommonOptions& common) {
    command
        .add_option("--cache", common.cache,
                    "Folder of cached references; default: SSRLAB_CACHE, else ssrlab in the user's cache folder")
        ->type_name("DIR");
}

void add_scene(CLI::App& command, std::string& scene) {
    command.add_option("scene", scene, "A scene's name (see: ssrlab list scenes), or a path to a .json, .gltf or .glb")
        ->required()
        ->type_name("SCENE");
}

/// `size`: two numbers; `otherwise`: what they are by default.
template <class Size>
void add_size(CLI::App& command, Size& size, const std::string& otherwise = "480 270") {
    command.add_option("--size", size, "Width and height in pixels; default: " + otherwise)
        ->expected(2)
        ->type_name("W H")
        ->check(CLI::Range(1, 16384));
}

void add_planes(CLI::App& command, ShotOptions& shot) {
    command
        .add_option("--planes", shot.planes,
                    "Near and far planes: camera, its own (default), or scene, derived so that they cut nothing")
        ->check(CLI::IsMember({"camera", "scene"}))
        ->type_name("WHOSE");
}

void add_animation(CLI::App& command, std::string& animation) {
    command
        .add_option("--animation", animation,
                    "Which of the glTF's animations is played; or all, or none; default: as its scene.json says, else "
                    "the first")
        ->type_name("NAME");
}

void add_shot(CLI::App& command, ShotOptions& shot) {
    add_scene(command, shot.scene), add_animation(command, shot.animation);
    command.add_option("--camera", shot.camera, "Default: the scene's first")->type_name("NAME");
    add_planes(command, shot);
    add_size(command, shot.size);
    command.add_option("--frame", shot.frame, "Frame of the camera's path and of the animation; default: 0")
        ->type_name("N");
}

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

/// As the command line of `ssrlab run` takes them, for studies that `command` makes.
std::vector<std::string> run_options(const CLI::App& command, const CommonOptions& common) {
    std::vector<std::string> options;
    if (command.count("--max-memory")) options.push_back("--max-memory=" + std::to_string(reading_limits().memory));
    if (reading_limits().allows_outside) options.push_back("--allow-outside");
    if (!common.device.empty()) options.push_back("--device=" + common.device);
    if (!common.cache.empty()) options.push_back("--cache=" + common.cache.string());
    for (const std::filesystem::path& folder : common.scene_path) options.push_back("--scene-path=" + folder.string());
    return options;
}

/// A technique's values: those of a preset, or its defaults, with others in their place.
void add_values(CLI::App& command, std::string& preset, nlohmann::json& parameters) {
    command.add_option("--preset", preset, "One of its presets; default: its defaults")->type_name("NAME");
    command
        .add_option_function<std::vector<std::string>>(
            "--set", [&parameters](const std::vector<std::string>& values) { parameters = parameters_of(values); },
            "A parameter's value; may be repeated")
        ->type_name("NAME=VALUE");
}

/// A command whose options a script declares, --help among them.
void hand_on(CLI::App& command, int (*call)(const std::vector<std::string>&), int& status) {
    command.prefix_command()->set_help_flag();
    command.callback([&command, call, &status] { status = call(command.remaining()); });
}

/// CLI11 would only say that some command is missing.
void refuse_unknown_command(const CLI::App& app, const std::string& name) {
    std::vector<std::string> names;
    for (const CLI::App* command : app.get_subcommands({})) {
        if (command->get_name() == name) return;
        if (!command->get_group().empty()) names.push_back(command->get_name());
    }
    fail("unknown command '", shortened(name), "'", suggestion(name, names));
}

/// CLI11 reports its own mistakes; they exit with 2 as all mistakes of the user do.
int parse_and_run(int argc, char** argv) {
    CLI::App app{
        "ssrlab compares screen-space reflection techniques with path-traced truth.\n"
        "Exit codes: 0 done, 2 an error in the request, 3 a fault of this machine, 130 stopped by Ctrl-C."};
    app.require_subcommand(1);
    app.get_formatter()->column_width(34);
    app.set_version_flag(
        "--version", [] { return build_info().dump(); },
        "Print version, commit and the hash of all code, as manifest.json has them");
    CommonOptions common;
    int status = 0;

    RunOptions run;
    CLI::App& run_command_ = *app.add_subcommand("run", "Run a study: shots x variants x parameter points x seeds");
    run_command_.add_option("config", run.config, "The study (experiments/README.md explains its keys)")
        ->required()
        ->type_name("CONFIG.json");
    run_command_
        .add_option("--out", run.out,
                    "Results folder; default: results/<name of the config>. A stopped study continues there")
        ->type_name("DIR");
    run_command_.add_flag("--keep-all", run.keep_all,
                          "Also do work that can be skipped (to verify that skipping it changes nothing)");
    run_command_.add_flag("--replace", run.replaces,
                          "Use a results folder of another study for this one; cells that both share are kept");
    run_command_.add_flag("--prune", run.prunes,
                          "Remove cells and images of earlier versions of the study from its folder");
    run_command_.add_flag("--times-here", run.takes_times_here,
                          "Take times on this machine again; by default those of another machine are kept");
    run_command_.add_flag("--times-again", run.takes_times_again,
                          "Take times again that other programs disturbed; the less disturbed are kept");
    run_command_.add_flag("--no-report", run.has_no_report,
                          "Write tables and images alone; `ssrlab report` makes the report of them later");
    run_command_
        .add_option("--report-after", run.report_after,
                    "Seconds of a running study until it writes tables and report of what is done; it goes on to do so "
                    "for a twenty-fifth of the time, after ten minutes for half a hundredth")
        ->check(real_in(0, std::numeric_limits<double>::max(), "a number of 0 or more"))
        ->capture_default_str()
        ->type_name("SECONDS");
    run_command_
        .add_option(
            "--cells", run.cells,
            "Do only these cells, of a study that several processes or machines share: references, renders, "
            "costs, times; shot=NAME, variant=NAME (* stands for any text); shard=I/N; cell=HASH. Terms of different "
            "kinds narrow each other. Tables are made by `ssrlab merge`")
        ->delimiter(',')
        ->type_name("TERM");
    add_device(run_command_, common), add_scene_path(run_command_, common), add_cache(run_command_, common);
    add_reading(run_command_);
    run_command_.callback([&] { run_study_command(run, common); });

    PlanOptions plan;
    CLI::App& plan_command_ = *app.add_subcommand(
        "plan", "List the cells of a study, which are done, and the estimated time and memory of the others");
    plan_command_.add_option("config", plan.config, "The study")->required()->type_name("CONFIG.json");
    plan_command_.add_option("--out", plan.out, "Its results folder; default: results/<name of the config>")
        ->type_name("DIR");
    plan_command_.add_option("--cells", plan.cells, "Only these cells, as for `ssrlab run`")
        ->delimiter(',')
        ->type_name("TERM");
    plan_command_.add_flag("--list", plan.has_list, "List the cells in place of estimates");
    plan_command_
        .add_option("--json", plan.json,
                    "Also write all cells with their estimates, for other machines: this one's memory is then no limit")
        ->type_name("FILE.json");
    plan_command_.add_flag("--keep-all", plan.keep_all, "As for `ssrlab run`");
    add_device(plan_command_, common), add_scene_path(plan_command_, common);
    add_reading(plan_command_);
    plan_command_.callback([&] { plan_command(plan, common); });

    MergeOptions merge;
    CLI::App& merge_command_ =
        *app.add_subcommand("merge", "Merge the results folders of a study's parts (`ssrlab run --cells`) into one");
    merge_command_.add_option("config", merge.config, "The study")->required()->type_name("CONFIG.json");
    merge_command_.add_option("results", merge.folders, "Folders of its parts; default: that of --out")
        ->check(CLI::ExistingDirectory)
        ->type_name("DIR...");
    merge_command_.add_option("--out", merge.out, "Results folder; default: results/<name of the config>")
        ->type_name("DIR");
    merge_command_.add_flag("--keep-all", merge.keep_all, "The parts were run with --keep-all");
    merge_command_.add_flag("--replace", merge.replaces, "As for `ssrlab run`");
    merge_command_
        .add_option("--device", common.device,
                    "Whose cells are merged, where the parts hold those of several devices: a part of its name, or an "
                    "index of `ssrlab list devices`; default: the one that made all, which need not be here")
        ->type_name("NAME");
    add_scene_path(merge_command_, common);
    add_reading(merge_command_);
    merge_command_.callback([&] { status = merge_command(merge, common); });

    std::filesystem::path report_folder;
    CLI::App& report_command_ = *app.add_subcommand("report", "Write report.html again from the tables of a folder");
    report_command_.add_option("results", report_folder, "A folder that `ssrlab run` or `ssrlab stability` filled")
        ->required()
        ->check(CLI::ExistingDirectory)
        ->type_name("DIR");
    bool links_images = false;
    report_command_.add_flag("--link-images", links_images,
                             "Keep all images beside the page, in report_images/, even if they are small");
    add_reading(report_command_);
    report_command_.callback([&] { report_command(report_folder, links_images); });

    hand_on(*app.add_subcommand(
                "figures",
                "Draw the figures of a paper (PDF, SVG, PNG) and animations of motion (GIF) from a results folder"),
            figures_command, status);

    DiffOptions diff;
    CLI::App& diff_command_ = *app.add_subcommand("diff",
                                                  "List the numbers that changed significantly between two results "
                                                  "folders (exit code 1 if any did; at most 5 % false alarms)");
    diff_command_.add_option("old", diff.before, "A folder that `ssrlab run` filled")->required()->type_name("OLD");
    diff_command_.add_option("new", diff.after, "Another, of the same shots and points")->required()->type_name("NEW");
    diff_command_.add_flag("--times", diff.judges_times, "Compare times, too, in one family with the errors");
    diff_command_.add_flag("--all", diff.shows_all, "List all changes, not only the largest");
    diff_command_.add_option("--csv", diff.csv, "Also write all compared numbers, with p-values and verdicts")
        ->type_name("FILE.csv");
    diff_command_
        .add_option("--page", diff.page,
                    "Also write a page with both pictures, their difference and the numbers of what changed")
        ->type_name("FILE.html");
    add_margin(diff_command_, diff.margin, "the new study's `primary.margin`");
    add_reading(diff_command_);
    diff_command_.callback([&] { status = diff_command(diff); });

    JudgeOptions judge;
    CLI::App& judge_command_ = *app.add_subcommand(
        "judge",
        "Judge the frames of another renderer by the truth, and against those that it rendered before: better, worse, "
        "equivalent, undecided or identical (at most 1 % false alarms)");
    judge_command_
        .add_option("frames", judge.frames,
                    "Folder with external.json and SCENE.CAMERA.WIDTHxHEIGHT/fFRAME.sSEED.exr (experiments/README.md, "
                    "\"Images of other programs\")")
        ->required()
        ->type_name("FRAMES");
    judge_command_
        .add_option("--scene", judge.scene,
                    "The scene of the views, by name or path; default: found by the names of the views' folders")
        ->type_name("SCENE");
    judge_command_.add_option("--capture", judge.capture, "A captured G-buffer in place of a scene")->type_name("DIR");
    judge_command_.add_option("--reference", judge.reference, "With --capture: the truth of its frame")
        ->type_name("FILE.exr");
    judge_command_
        .add_option("--against", judge.against, "Such a folder of earlier frames of the same renderer and views")
        ->type_name("FOLDER");
    judge_command_.add_flag("--fail-if-worse", judge.fails_if_worse, "Exit code 1 if the verdict is \"worse\"");
    judge_command_.add_option("--samples", judge.samples, "Of the truth, per pixel; default: 256")
        ->type_name("N")
        ->check(CLI::Range(32, 1 << 20));
    judge_command_.add_option("--out", judge.out, "Results folder with the page; default: results/judge")
        ->type_name("DIR");
    add_margin(judge_command_, judge.margin, "0.05");
    add_scene_path(judge_command_, common), add_device(judge_command_, common), add_cache(judge_command_, common);
    add_reading(judge_command_);
    judge_command_.callback([&] { status = judge_command(judge, common); });

    SceneForOptions scene_for;
    CLI::App& scene_for_command_ = *app.add_subcommand(
        "scene-for",
        "Write a scene's views for another program: glTF, poses, and the light that its reflections are to be computed "
        "from");
    scene_for_command_
        .add_option("engine", scene_for.engine, "any, three, babylon, eevee or godot: decides the files' formats")
        ->required()
        ->type_name("ENGINE");
    add_scene(scene_for_command_, scene_for.scene);
    add_animation(scene_for_command_, scene_for.animation);
    scene_for_command_.add_option("--camera", scene_for.cameras, "One or more; default: the scene's first")
        ->type_name("NAME");
    add_size(scene_for_command_, scene_for.size);
    scene_for_command_
        .add_option("--frames", scene_for.frames,
                    "Frames of the cameras' paths and of the animation, as 0-63 or 0 8 16")
        ->capture_default_str()
        ->type_name("N");
    scene_for_command_
        .add_option(
            "--samples", scene_for.samples,
            "Of the truth, per pixel: those of the study that will compare the images, which then finds it cached")
        ->check(CLI::Range(16, 1 << 24))
        ->capture_default_str();
    scene_for_command_.add_option("--lit-samples", scene_for.lit_samples, "As the study's; default: all")
        ->check(CLI::Range(16, 1 << 24));
    scene_for_command_.add_flag("--ladder", scene_for.has_ladder, "The study has targets of the truth ladder");
    scene_for_command_
        .add_option("--fallback", scene_for.fallback,
                    "As the study's: what rays see that find nothing. A probe shows a room from the camera's place, "
                    "where the environment is the sky behind its walls")
        ->check(CLI::IsMember({"environment", "probe"}))
        ->capture_default_str();
    scene_for_command_.add_option("--out", scene_for.out, "Folder")->required()->type_name("DIR");
    add_scene_path(scene_for_command_, common), add_cache(scene_for_command_, common);
    add_reading(scene_for_command_);
    scene_for_command_.callback([&] { scene_for_command(scene_for, common); });

    hand_on(*app.add_subcommand("tables", "Make a study's tables (Markdown, LaTeX, CSV) from a results folder"),
            tables_command, status);

    TradeoffOptions tradeoff;
    CLI::App& tradeoff_command_ = *app.add_subcommand(
        "tradeoff",
        "Answer error against time: fronts, the best technique for a time budget, errors that no time removes");
    tradeoff_command_.add_option("results", tradeoff.results, "A folder that `ssrlab run` filled")
        ->required()
        ->type_name("DIR");
    tradeoff_command_.add_option("--out", tradeoff.out, "Default: tradeoff in the results folder")->type_name("DIR");
    tradeoff_command_
        .add_option("--baseline", tradeoff.baseline,
                    "Errors are multiples of this point's; default: none, else the study's first baseline")
        ->type_name("VARIANT:POINT");
    tradeoff_command_
        .add_option("--times", tradeoff.times, "Time budgets, or budgets of what --cost counts or estimates")
        ->check(positive())
        ->capture_default_str()
        ->type_name("MS");
    tradeoff_command_
        .add_option("--factors", tradeoff.factors, "Fractions of the baseline's error, for the time to reach them")
        ->check(positive())
        ->capture_default_str()
        ->type_name("F");
    tradeoff_command_.add_option("--leave-out", tradeoff.left_out, "Scenes or shots to exclude")->type_name("SCENE");
    add_margin(tradeoff_command_, tradeoff.margin, "the study's `primary.margin`");
    tradeoff_command_.add_option("--metric", tradeoff.metric, "Default: that of the study's primary error");
    tradeoff_command_.add_option("--mask", tradeoff.mask, "Default: that of the study's primary error");
    tradeoff_command_.add_option("--target", tradeoff.target, "Default: that of the study's primary error");
    tradeoff_command_
        .add_option("--cost", tradeoff.cost,
                    "A counted quantity of costs.csv, or a chip of estimates.csv, in place of time")
        ->type_name("QUANTITY|CHIP");
    add_reading(tradeoff_command_);
    tradeoff_command_.callback([&] { status = tradeoff_command(tradeoff); });

    CLI::App& statistics_command_ = *app.add_subcommand("statistics", "Answer the questions of ssrlab's own scripts");
    statistics_command_.group("")->callback([] { statistics_command(); });  // not shown by --help

    TuneOptions tune;
    CLI::App& tune_command_ = *app.add_subcommand(
        "tune",
        "Search a technique's parameters for the front of error against time, and evaluate them on other scenes");
    tune_command_.add_option("config", tune.config, "A study with \"tune\" (experiments/README.md)")
        ->required()
        ->type_name("CONFIG.json");
    tune_command_.add_option("--out", tune.out, "Default: results/<name of the config>")->type_name("DIR");
    add_device(tune_command_, common), add_scene_path(tune_command_, common), add_cache(tune_command_, common);
    add_reading(tune_command_);
    tune_command_.callback([&] { status = tune_command(tune, run_options(tune_command_, common)); });

    CompareCommandOptions compare;
    CLI::App& compare_command_ =
        *app.add_subcommand("compare", "Compare two images (OpenEXR, Radiance or PNG): one number per line");
    compare_command_.add_option("reference", compare.reference, "What is right: .exr (linear radiance) or .png (sRGB)")
        ->required()
        ->type_name("REFERENCE");
    compare_command_.add_option("test", compare.test, "What is judged, of the same size and kind")
        ->required()
        ->type_name("TEST");
    compare_command_
        .add_option("--metric", compare.metrics,
                    "May be repeated; see: ssrlab list metrics; default: mse, relmse, relmse_trimmed, outliers, mae, "
                    "smape, bias, energy_ratio, psnr, flip, where the image is large enough ssim and "
                    "ms_ssim, and hdr_flip of an EXR reference")
        ->type_name("NAME");
    compare_command_
        .add_option(
            "--layer", compare.layer,
            "Layer, part, view or channel of EXR files that have several, such as specular; default: that without "
            "a name, else image, as of files by `ssrlab reference`, else the only one with R, G and B")
        ->type_name("NAME");
    compare_command_
        .add_option("--map", compare.map,
                    "Write the error map: .exr (a layer per metric) or .png (one metric, in false colour)")
        ->type_name("FILE");
    compare_command_.add_option("--map-max", compare.map_max, "The error shown in the brightest colour of a .png map")
        ->check(positive())
        ->capture_default_str();
    compare_command_.add_option("--exposure", compare.exposure_ev, "Display metrics use radiance times 2^EV")
        ->type_name("EV")
        ->check(real_in(-100, 100, "a number from -100 to 100"))
        ->capture_default_str();
    compare_command_.add_option("--tone-map", compare.tone_map, "Applied before display metrics (psnr, ssim, flip)")
        ->check(CLI::IsMember(tone_map_names))
        ->capture_default_str();
    compare_command_.add_flag(
        "--fail-on-non-finite", compare.fail_on_non_finite,
        "Exit with 2 if a pixel is NaN or Inf; by default such pixels are excluded and counted in a warning");
    compare_command_.add_flag("--json", compare.as_json, "Print one JSON object");
    add_reading(compare_command_);
    compare_command_.callback([&] { compare_images_command(compare); });

    ReferenceCommandOptions reference;
    CLI::App& reference_command_ = *app.add_subcommand("reference", "Path-trace a scene; continues a stopped render");
    add_shot(reference_command_, reference.shot);
    reference_command_
        .add_option("--samples", reference.settings.max_samples,
                    "Per pixel, at most; rounded up to 16 x 2^k; default: " +
                        std::to_string(ReferenceSettings::default_samples) + ", or no limit with --seconds or --target")
        ->check(CLI::Range(16, 1 << 24));
    reference_command_
        .add_option("--lit-samples", reference.settings.lit_samples,
                    "Of these of the diffuse light, at most: the rest is of the specular light alone; default: all")
        ->check(CLI::Range(16, 1 << 24));
    reference_command_
        .add_option("--guide-samples", reference.settings.guide_samples,
                    "Per pixel of the guide, which weighs relative errors and tells roulette what to expect")
        ->check(CLI::Range(16, 4096))
        ->capture_default_str();
    reference_command_
        .add_option("--seconds", reference.settings.max_seconds,
                    "Time limit, beside the samples of the guide; default: none")
        ->check(positive());
    reference_command_
        .add_option("--target", reference.settings.target_relative_error,
                    "Stop at this relative standard error of the specular light at a pixel, e.g. 0.03")
        ->check(real_in(1e-4, 1, "a number from 0.0001 to 1"));
    reference_command_
        .add_option("--max-depth", reference.settings.max_depth,
                    "Reflections of a path at most; the camera ray does not count")
        ->check(CLI::Range(1, 1024))
        ->capture_default_str();
    reference_command_.add_option("--seed", reference.settings.seed, "Seed of the path tracer")->capture_default_str();
    reference_command_.add_flag("--ladder", reference.settings.ladder,
                                "Also the truth ladder: lower bounds of the errors by factoring the BRDF, one view and "
                                "bounce, and the borders of the screen; about twice the rays");
    reference_command_.add_option("--out", reference.out, "Default: <scene>_reference.exr")->type_name("FILE.exr");
    add_scene_path(reference_command_, common), add_cache(reference_command_, common);
    add_reading(reference_command_);
    reference_command_.callback([&] { reference_command(reference, common); });

    GBufferCommandOptions gbuffer;
    CLI::App& gbuffer_command_ =
        *app.add_subcommand("gbuffer", "Rasterise a scene's G-buffer into gbuffer.exr and camera.json");
    add_shot(gbuffer_command_, gbuffer.shot);
    gbuffer_command_
        .add_option("--frames", gbuffer.frames, "First and last, both included: a capture of frames in a row")
        ->expected(2)
        ->type_name("A B")
        ->excludes("--frame");
    gbuffer_command_.add_option("--out", gbuffer.out, "Folder; default: <scene>_gbuffer")->type_name("DIR");
    gbuffer_command_.add_option("--depth-format", gbuffer.depth_format)
        ->check(CLI::IsMember({"d32f", "d24", "d16"}))
        ->capture_default_str();
    gbuffer_command_.add_flag("--reversed-depth", gbuffer.is_reversed, "1 at the near plane, 0 at the far plane");
    add_device(gbuffer_command_, common), add_scene_path(gbuffer_command_, common);
    add_reading(gbuffer_command_);
    gbuffer_command_.callback([&] { gbuffer_command(gbuffer, common); });

    CaptureCommandOptions capture;
    CLI::App& capture_command_ =
        *app.add_subcommand("capture", "Check a capture of an engine's G-buffers, and list its layers");
    capture_command_
        .add_option("folder", capture.folder,
                    "With gbuffer.exr and camera.json, or with folders frame_<number> of them")
        ->required()
        ->type_name("DIR");
    add_reading(capture_command_);
    capture_command_.callback([&] { capture_command(capture); });

    InspectOptions inspect;
    CLI::App& inspect_command_ = *app.add_subcommand(
        "inspect", "Show what ssrlab understands of a file: a scene, an image, a capture or an engine's frames");
    inspect_command_
        .add_option("file", inspect.file,
                    "A .gltf, .glb or scene.json, a folder with one, a scene's name, an image, the folder of a capture "
                    "or of an engine's frames")
        ->required()
        ->type_name("FILE");
    inspect_command_.add_flag("--all", inspect.has_all, "Lists in full; default: the first eight entries of each");
    inspect_command_.add_option("--json", inspect.json, "Also write all of it as JSON; -: print that alone")
        ->type_name("FILE.json");
    inspect_command_
        .add_option("--picture", inspect.picture,
                    "Also draw a scene's first view by both renderers, and where they differ")
        ->type_name("FILE.png");
    add_device(inspect_command_, common), add_scene_path(inspect_command_, common);
    add_reading(inspect_command_);
    inspect_command_.callback([&] { inspect_command(inspect, common); });

    NeedsOptions needs;
    CLI::App& needs_command_ = *app.add_subcommand(
        "needs",
        "List what a scene holds, the work that rasteriser, path tracer and techniques skip, and what that saves");
    add_shot(needs_command_, needs.shot);
    needs_command_
        .add_option("--frames", needs.frames, "Number of frames of the shot; default: 1, so that nothing moves")
        ->check(CLI::Range(1, 10000))
        ->type_name("N");
    needs_command_
        .add_option("--variants", needs.variants,
                    "Techniques, or their folders, or single presets as NAME:PRESET; default: all presets of all, and "
                    "all tracers")
        ->delimiter(',')
        ->type_name("NAME");
    needs_command_.add_flag("--measure", needs.is_measured,
                            "Render with and without skipped work: the time saved, and whether images are the same "
                            "(exit code 1 if not)");
    needs_command_.add_option("--timed-frames", needs.timed_frames, "Measured frames of each; default: 15")
        ->check(CLI::Range(1, 10000))
        ->type_name("N");
    needs_command_.add_option("--csv", needs.csv, "Also write the measurements")->type_name("FILE.csv");
    add_device(needs_command_, common), add_scene_path(needs_command_, common);
    add_reading(needs_command_);
    needs_command_.callback([&] { status = needs_command(needs, common); });

    ShadersOptions shaders{.shot = {.scene = "mirror_pillars", .camera = {}, .size = {96, 54}}};
    shaders.chips.assign(default_chips.begin(), default_chips.end());
    CLI::App& shaders_command_ = *app.add_subcommand(
        "shaders", "Show what compilers of GPUs make of a technique's passes: registers, occupancy, instructions");
    shaders_command_
        .add_option("variant", shaders.variant, "A technique (see: ssrlab list variants), or its folder, with a /")
        ->required()
        ->type_name("NAME");
    add_values(shaders_command_, shaders.preset, shaders.parameters);
    shaders_command_
        .add_option(
            "--chip", shaders.chips,
            "GPUs by the names that Mesa's radv has for them (see: ssrlab list chips); default: navi21, gfx1100, "
            "vega10")
        ->delimiter(',')
        ->type_name("NAME");
    shaders_command_
        .add_option("--against", shaders.against,
                    "Also show what differs from another preset, or from a study with \"gpu_compilers\"")
        ->type_name("PRESET|RESULTS");
    shaders_command_
        .add_option("--assembly", shaders.assembly, "Write the machine code of each shader into this folder")
        ->type_name("DIR");
    shaders_command_.add_option("--csv", shaders.csv, "Also write the table")->type_name("FILE.csv");
    CLI::Option* const scene = shaders_command_.add_option(
        "--scene", shaders.shot.scene,
        "Leave out what this scene does not need; default: nothing is left out, and mirror_pillars is rendered");
    scene->type_name("SCENE");
    add_device(shaders_command_, common), add_scene_path(shaders_command_, common), add_cache(shaders_command_, common);
    add_reading(shaders_command_);
    shaders_command_.callback([&] {
        shaders.leaves_out = scene->count() > 0;
        shaders_command(shaders, common);
    });

    RaysOptions rays;
    CLI::App& rays_command_ =
        *app.add_subcommand("rays", "Trace the mirror rays of what reflects, and print where they end as a table");
    rays_command_
        .add_option("scenes", rays.scenes, "Scenes, each seen by its first camera; room:* stands for several in a row")
        ->required()
        ->type_name("SCENE...");
    rays_command_.add_option("--count", rays.count, "How many scenes room:* stands for")
        ->check(CLI::Range(1u, largest_scene_number + 1))
        ->capture_default_str()
        ->type_name("N");
    rays_command_.add_option("--first", rays.first, "The number of the first of them")
        ->check(CLI::Range(0u, largest_scene_number))
        ->capture_default_str()
        ->type_name("N");
    add_size(rays_command_, rays.size, "160 90");
    add_scene_path(rays_command_, common);
    add_reading(rays_command_);
    rays_command_.callback([&] { rays_command(rays, common); });

    RecordOptions record;
    CLI::App& record_command_ = *app.add_subcommand(
        "record", "Write a page in which a browser does a technique's passes again (WebGL 2), beside the truth");
    add_scene(record_command_, record.shot.scene);
    record_command_
        .add_option(
            "--variant", record.variant,
            "A technique of fragment passes alone (see: ssrlab list variants), or its folder; others are refused")
        ->required()
        ->type_name("NAME");
    add_values(record_command_, record.preset, record.parameters);
    record_command_.add_option("--camera", record.shot.camera, "Default: the scene's first")->type_name("NAME");
    add_planes(record_command_, record.shot);
    add_animation(record_command_, record.shot.animation);
    add_size(record_command_, record.shot.size, "192 108");
    record_command_.add_option("--frames", record.frames, "Frames of the camera's path and of the animation")
        ->capture_default_str()
        ->type_name("A-B");
    record_command_.add_option("--samples", record.samples, "Of the truth, per pixel")
        ->check(CLI::Range(1, 1 << 24))
        ->capture_default_str()
        ->type_name("N");
    record_command_.add_flag("--packed", record.is_packed,
                             "G-buffer in the formats of engines, so that the page is smaller; default: float32");
    record_command_.add_flag("--results", record.has_results,
                             "Also what this device rendered, so that the page says where a browser differs from it");
    record_command_.add_flag("--passes", record.has_passes,
                             "Also what each pass of this device wrote, so that the page compares one by one");
    record_command_.add_option("--out", record.out, "The page")->required()->type_name("PAGE.html");
    add_device(record_command_, common), add_scene_path(record_command_, common), add_cache(record_command_, common);
    add_reading(record_command_);
    record_command_.callback([&] { record_command(record, common); });

    WatchOptions watch;
    CLI::App& watch_command_ = *app.add_subcommand(
        "watch", "Render and judge a technique's folder whenever it is saved, and show it on a page of this machine");
    watch_command_.add_option("folder", watch.folder, "With technique.json and shaders (ssrlab new makes one)")
        ->required()
        ->type_name("FOLDER");
    watch_command_
        .add_option("--scene", watch.scenes,
                    "One or more, by name (see: ssrlab list scenes) or path; the first is shown first")
        ->required()
        ->type_name("SCENE...");
    watch_command_
        .add_option(
            "--against", watch.against,
            "Also compare with this technique, NAME or NAME:PRESET, or another folder; best: what errs least in "
            "the included studies")
        ->type_name("NAME");
    watch_command_.add_option("--preset", watch.preset, "One of the technique's presets; default: its defaults")
        ->type_name("NAME");
    watch_command_.add_option("--camera", watch.camera, "Default: each scene's first")->type_name("NAME");
    add_size(watch_command_, watch.size);
    watch_command_
        .add_option("--frames", watch.frames,
                    "Frames of the camera's path and of the animation, for histories; the last is measured")
        ->capture_default_str()
        ->type_name("A-B");
    watch_command_.add_option("--samples", watch.samples, "Of the truth, per pixel")
        ->check(CLI::Range(32, 1 << 20))
        ->capture_default_str()
        ->type_name("N");
    watch_command_.add_option("--seeds", watch.seeds, "Of techniques that draw random numbers; default: 8")
        ->check(CLI::Range(1, 1000))
        ->type_name("N");
    watch_command_
        .add_option("--patience", watch.patience,
                    "Seconds without a sign of life after which rendering is ended, as of a loop without end")
        ->check(real_in(15, 1e6, "a number from 15, as there is a sign every ten seconds, to 1000000"))
        ->capture_default_str()
        ->type_name("SECONDS");
    watch_command_
        .add_option("--out", watch.out,
                    "Folder of kept versions and of what is rendered; default: results/watch/<name>")
        ->type_name("DIR");
    add_device(watch_command_, common), add_scene_path(watch_command_, common), add_cache(watch_command_, common);
    add_reading(watch_command_);
    watch_command_.callback([&] { watch_command(watch, run_options(watch_command_, common)); });

    StabilityOptions stability;
    CLI::App& stability_command_ =
        *app.add_subcommand("stability", "Test techniques with extreme inputs: non-finite values and amplification");
    stability_command_
        .add_option("--variants", stability.variants,
                    "Techniques, or their folders, or single presets as NAME:PRESET; default: all presets of all, and "
                    "all tracers")
        ->delimiter(',')
        ->type_name("NAME");
    stability_command_.add_option("--cases", stability.cases, "Cases or groups of the table; default: all")
        ->delimiter(',')
        ->type_name("NAME");
    stability_command_
        .add_option("--table", stability.table,
                    "A table of cases (experiments/stability/README.md); default: ssrlab's own")
        ->check(CLI::ExistingFile)
        ->type_name("FILE.json");
    stability_command_.add_option("--out", stability.out, "Folder of stability.csv")
        ->default_val("results/stability")
        ->type_name("DIR");
    stability_command_.add_flag("--all-stages", stability.has_all_stages,
                                "List every stage in stability_stages.csv, also those that are finite");
    stability_command_.add_option("--figure", stability.figure, "Also write the figure: .pdf, .png or .svg")
        ->type_name("FILE");
    stability_command_.add_flag("--precision", stability.is_of_precision,
                                "Instead: formats and arithmetic, in half, float and double, one image and "
                                "one stage at a time (5 minutes; stability_precision.csv)");
    add_device(stability_command_, common), add_scene_path(stability_command_, common);
    add_cache(stability_command_, common);
    add_reading(stability_command_);
    stability_command_.callback([&] {
        status =
            stability.is_of_precision ? precision_command(stability, common) : stability_command(stability, common);
    });

    NewOptions new_technique;
    CLI::App& new_command_ = *app.add_subcommand(
        "new", "Write a technique of one's own as a folder, which needs no compiler, and a first study of it");
    new_command_.add_option("folder", new_technique.folder, "The folder to make; its name is the technique's")
        ->required()
        ->type_name("FOLDER");
    new_command_
        .add_option("--from", new_technique.from,
                    "What it begins as: mcguire_dda, simple_ssr or four_mode_ssr, or a technique's folder; default: "
                    "mcguire_dda")
        ->type_name("TECHNIQUE");
    new_command_.callback([&] { new_command(new_technique); });

    DescribeOptions describe;
    CLI::App& describe_command_ =
        *app.add_subcommand("describe", "Print every parameter: default, range, unit, meaning, source");
    describe_command_
        .add_option("variant", describe.variant,
                    "A variant or its folder, a tracer or a resolve; default: all variants")
        ->type_name("NAME");
    describe_command_.add_flag("--schema", describe.as_schema,
                               "Print a JSON Schema for configs, so that editors complete them");
    describe_command_
        .add_option("--fill", describe.document,
                    "In place of printing make the tables of a config's keys in a document anew")
        ->type_name("FILE.md");
    describe_command_.callback([&] { describe_command(describe); });

    std::string what;
    CLI::App& list_command_ = *app.add_subcommand(
        "list",
        "List scenes and what each tests, variants, their presets, tracers, resolves, metrics, devices or chips");
    list_command_.add_option("what", what, "What to list")
        ->required()
        ->check(CLI::IsMember({"scenes", "variants", "presets", "tracers", "resolves", "metrics", "devices", "chips"}))
        ->type_name("scenes|variants|presets|tracers|resolves|metrics|devices|chips");
    add_scene_path(list_command_, common);
    add_reading(list_command_);
    list_command_.callback([&] { list_command(what, common); });

    if (argc > 1 && argv[1][0] != '-') refuse_unknown_command(app, argv[1]);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& e) {
        return app.exit(e) == 0 ? 0 : 2;
    }
    return status;
}

/// A mistake in a file that is there is seen best by who looks at all that is understood of it.
void say_how_to_inspect(int argc, char** argv, const Error& error) {
    if (argc > 1 && std::string_view(argv[1]) == "inspect") return;
    const std::string hint = inspect_hint(error.what());
    if (!hint.empty()) std::fprintf(stderr, "note: %s\n", shown_text(hint).c_str());
}

}  // namespace

int main(int argc, char** argv) {
    try {
        return parse_and_run(argc, argv);
    } catch (const MachineError& e) {
        std::fprintf(stderr, "error: %s\n", shown_text(e.what()).c_str());
        return 3;
    } catch (const ShaderError& e) {
        std::fprintf(stderr, "error: %s\n", e.what());
        return 2;
    } catch (const Error& e) {
        std::fprintf(stderr, "error: %s\n", shown_text(e.what()).c_str());
        say_how_to_inspect(argc, argv, e);
        return 2;
    } catch (const std::bad_alloc&) {
        std::fprintf(stderr, "error: not enough memory\n");
        return 3;
    } catch (const std::exception& e) {
        std::fprintf(stderr, "error: %s\n", shown_text(e.what()).c_str());
        return 3;
    }
}
