// The commands that are modules of Python (figures, tables, tune), and tradeoff.
#include "experiments/cli/script_commands.h"
#include "core/child_process.h"
#include "core/error.h"
#include "core/files.h"
#include "core/list_text.h"
#include "core/own_files.h"
#include "core/path_inside.h"
#include "core/shown_text.h"
#include "experiments/cli/commands.h"
#include "experiments/cli/config_of_study.h"
#include "experiments/cli/help_page.h"
#include "experiments/gpu_costs/chips/chip_compiler.h"
#include "experiments/results/cells/host_info.h"
#include "experiments/results/tradeoff/tradeoff_answers.h"
#include "experiments/results/verdicts/study_points.h"
#include "experiments/study/config/config.h"
#include "experiments/study/config/config_parts.h"
#include "metrics/estimators.h"
#include "variants/registry.h"

#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <nlohmann/json.hpp>

namespace {

struct TradeoffOptions {
    std::filesystem::path results, out, costs_from;
    std::string baseline, metric, mask, target, cost;                   ///< empty: the study's own, and time
    std::vector<double> times{5, 10, 20, 40}, factors{0.5, 0.25, 0.1};  ///< ms or counts; of the baseline's error
    std::vector<std::string> left_out;                                  ///< scenes or shots
    double margin = 0;                                                  ///< 0: the study's own
};

struct TuneOptions {
    std::filesystem::path config, out;
    bool allows_program = false;
};

/// Runs a module of experiments/python/ssrlab: 0 done, 2 a mistake of the user, else a fault of the machine (3).
int run_module(const std::string& name, const std::vector<std::string>& arguments) {
    std::vector<std::string> command = {SSRLAB_PYTHON, "-B", (own_files() / "experiments/python").string(), name};
    command.insert(command.end(), arguments.begin(), arguments.end());
    const int code = run_program(command);
    return code == 0 || code == 2 ? code : 3;
}

}  // namespace

int figures_command(const std::vector<std::string>& arguments) { return run_module("figures", arguments); }

int stability_figure(const std::filesystem::path& csv, const std::filesystem::path& figure) {
    return run_module("figures.stability", {"--out=" + figure.string(), "--", csv.string()});
}

static int tables_command(const std::vector<std::string>& arguments) {
    std::vector<std::string> handed_on = arguments;
    for (std::string& argument : handed_on)  // the script compares what is kept with the estimators of this program
        if (argument == "--check") argument += "=" + std::to_string(estimator_version);
    return run_module("tables", handed_on);
}

static int tradeoff_command(const TradeoffOptions& options) {
    StudyResults tables = read_study_results(options.results);
    std::vector<CostsOfKind> costs_from;
    if (!options.costs_from.empty()) {
        if (options.cost.empty()) fail("--costs-from takes the estimated times of a chip; name the chip with --cost");
        costs_from = take_costs_from(read_study_results(options.costs_from, Runs::left_out), options.cost, tables);
    }
    PrimaryComparisons error = primary_of(tables.manifest);
    if (!options.metric.empty()) error.metric = options.metric;
    if (!options.mask.empty()) error.mask = options.mask;
    if (!options.target.empty()) error.target = options.target;
    if (options.margin > 0) error.margin = options.margin;
    std::vector<double> costs = options.times;
    std::ranges::sort(costs);
    Tradeoff found = tradeoff_of(tables, {.error = error,
                                          .cost = options.cost,
                                          .baseline = options.baseline,
                                          .costs = costs,
                                          .left_out = options.left_out});
    found.costs_from = std::move(costs_from);
    const std::filesystem::path out = options.out.empty() ? path_inside(options.results, "tradeoff") : options.out;
    create_folder(out);
    write_rows(out / "pairs.csv", found.pairs);
    write_rows(out / "front.csv", found.front);
    write_rows(out / "across.csv", found.across);
    write_rows(out / "stages.csv", found.changes);
    write_text(out / "frozen.json", nlohmann::json{{"frozen", frozen_json(found.to_freeze)}}.dump(2) + "\n");
    std::vector<double> factors = options.factors;
    std::ranges::sort(factors, std::greater());
    const BetweenPoints between = between_points(tables, error, found, costs, factors);
    write_rows(out / "error_at_cost.csv", between.error_at_cost);
    write_rows(out / "cost_to_error.csv", between.cost_to_error);
    write_rows(out / "fits.csv", between.fits);
    write_rows(out / "limits.csv", between.limits);
    write_text(out / "answers.md", tradeoff_answers(tables, error, found, between, costs, factors));
    std::cout << shown_text((out / "answers.md").string()) << "\n";
    return 0;
}

namespace {

/// The name of a technique of ssrlab, or else its folder, wherever the config lies.
std::string named_in_configs(const PointConfig& point) {
    if (point.external) return point.technique;
    const TechniqueEntry& entry = find_technique(point.technique);
    return entry.is_ssrlabs() ? entry.name : entry.folder->path.string();
}

}  // namespace

static int tune_command(const TuneOptions& options, const std::vector<std::string>& run_options) {
    using nlohmann::json;
    const std::filesystem::path file = study_file(options.config);
    const Config config = read_config(file);
    if (!config.is_tuned) fail(file.string(), ": has no 'tune'; `ssrlab run` runs a study");
    if (!config.source["tune"].contains("axes")) fail(file.string(), ": 'tune' has no 'axes'; it can only be extended");
    const std::filesystem::path out = options.out.empty() ? default_results(file) : options.out;
    const json rules = tuning_of(config);
    if (rules.contains("program") && !options.allows_program)
        fail(file.string(), ": the search runs the program '",
             joined(rules["program"].get<std::vector<std::string>>(), " "),
             "', which may do anything that you may. If you trust the config, add --allow-program");
    if (rules["is_estimated"]) find_chip(rules["time"]);  // or says why it cannot be asked
    json points = json::array();
    for (const PointConfig& v : config.techniques)
        points.push_back({{"technique", named_in_configs(v)},
                          {"preset", v.preset},
                          {"parameters", v.parameters},
                          {"swept", v.swept},
                          {"point", v.point},
                          {"label", v.label},
                          {"baseline", v.is_baseline}});
    const json asked = {
        {"study", config.source},
        {"tune", rules},
        {"points", points},
        {"parameters",
         rules.contains("program") ? json::object() : config_schema(config.techniques.front().technique)["properties"]},
        {"folder", std::filesystem::absolute(file).parent_path().string()}};
    create_folder(out);
    write_text(out / "tune.json", asked.dump(1) + "\n");  // without comments, which Python does not read
    std::vector<std::string> arguments = {"--out=" + out.string(), (out / "tune.json").string(), "--",
                                          this_program().string()};
    arguments.insert(arguments.end(), run_options.begin(), run_options.end());
    return run_module("tune", arguments);
}

/// A command whose options a script declares, --help among them.
static void hand_on(CLI::App& command, int (*call)(const std::vector<std::string>&), Commands& line) {
    command.prefix_command()->set_help_flag();
    command.callback([&command, call, &line] {
        const std::vector<std::string> words = command.remaining();
        if (std::ranges::count(words, "--help") || std::ranges::count(words, "-h"))
            std::cout << example_line(command) << std::endl;  // before what the script prints
        line.status = call(words);
    });
}

void add_figures(Commands& line) {
    hand_on(line.add("figures",
                     "Draw figures for papers (PDF, SVG, PNG) and animations of motion (GIF) from a results folder",
                     "ssrlab figures results/quickstart --choice my_figures.json"),
            figures_command, line);
}

void add_tables(Commands& line) {
    hand_on(line.add("tables", "Make the tables of a study (Markdown, LaTeX, CSV) from a results folder",
                     "ssrlab tables results/my_study"),
            tables_command, line);
}

void add_tradeoff(Commands& line) {
    TradeoffOptions& tradeoff = line.keep<TradeoffOptions>();
    CLI::App& command = line.add("tradeoff",
                                 "Find the best technique for a time budget, the fronts of error against time, and the "
                                 "errors that no time removes",
                                 "ssrlab tradeoff results/quickstart --times 5 10 20");
    option(command, "results DIR", tradeoff.results, "Results folder that `ssrlab run` filled")->required();
    option(command, "--out DIR", tradeoff.out, "Folder of the answers; default: tradeoff in the results folder");
    option(command, "--baseline TECHNIQUE:POINT", tradeoff.baseline,
           "Point whose error is the unit of all errors; default: none, else the first baseline of the study");
    option(command, "--times MS", tradeoff.times, "Budgets of time, or of what --cost names")
        ->check(positive())
        ->capture_default_str();
    option(command, "--factors F", tradeoff.factors,
           "Fractions of the baseline's error; the time to reach each is reported")
        ->check(positive())
        ->capture_default_str();
    option(command, "--leave-out SCENE", tradeoff.left_out, "Scene or shot to leave out; may be repeated");
    add_margin(command, tradeoff.margin, "the study's `primary.margin`");
    option(command, "--metric NAME", tradeoff.metric,
           "Metric of the error; default: that of the study's primary error");
    option(command, "--mask NAME", tradeoff.mask, "Mask of the error; default: that of the study's primary error");
    option(command, "--target NAME", tradeoff.target,
           "Target of the error; default: that of the study's primary error");
    option(command, "--cost QUANTITY|CHIP", tradeoff.cost,
           "What replaces time: a counted quantity of costs.csv, or the estimated time of a chip in estimates.csv");
    option(command, "--costs-from DIR", tradeoff.costs_from,
           "Results folder with the estimates of --cost, if other shots have them: means over its shots of the group "
           "that a shot's own group begins with");
    add_reading(command);
    command.callback([&] { line.status = tradeoff_command(tradeoff); });
}

void add_tune(Commands& line) {
    TuneOptions& tune = line.keep<TuneOptions>();
    CLI::App& command = line.add(
        "tune",
        "Search the parameters of a technique for the least error within a time, and evaluate them on other scenes",
        "ssrlab tune my_search.json");
    add_config(command, tune.config, "; its key \"tune\" is explained in `experiments/docs/tune.md`");
    option(command, "--out DIR", tune.out, "Results folder; default: results/<name of the config>");
    command.add_flag("--allow-program", tune.allows_program, "Run the program that the key \"program\" names");
    add_device(command, line.common), add_scene_path(command, line.common), add_cache(command, line.common);
    add_reading(command);
    command.callback([&] { line.status = tune_command(tune, run_options(command, line.common)); });
}
