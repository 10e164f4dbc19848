// The commands that are Python scripts: figures, tables, tradeoff, tune.
#include "core/child_process.h"
#include "core/error.h"
#include "core/files.h"
#include "core/gpu/chips/chip_compiler.h"
#include "core/gpu/chips/model_range.h"
#include "core/path_inside.h"
#include "experiments/commands/commands.h"
#include "experiments/config/config.h"
#include "experiments/config/config_parts.h"
#include "experiments/config/config_schema.h"
#include "experiments/evaluation/study_points.h"
#include "experiments/evaluation/tradeoff/tradeoff.h"
#include "experiments/measuring/costs/counts_spread.h"
#include "experiments/store/host_info.h"
#include "metrics/estimators.h"
#include "variants/registry.h"

#include <algorithm>
#include <cstdlib>
#include <nlohmann/json.hpp>

namespace {

/// Runs a script of experiments/: 0 done, 2 a mistake of the user, else a fault of the machine (3). Scripts ask this
/// program for their statistics (experiments/python/ssrlab/statistics.py).
int run_script(const std::string& name, const std::vector<std::string>& arguments) {
    setenv("SSRLAB_PROGRAM", this_program().c_str(), 1);
    std::vector<std::string> command = {SSRLAB_PYTHON, "-B", SSRLAB_SOURCE_DIR "/experiments/" + name};
    command.insert(command.end(), arguments.begin(), arguments.end());
    const int code = run_program(command);
    return code == 0 || code == 2 ? code : 3;
}

}  // namespace

int figures_command(const std::vector<std::string>& arguments) { return run_script("figures/figures.py", arguments); }

int stability_figure(const std::filesystem::path& csv, const std::filesystem::path& figure) {
    return run_script("figures/stability_figure.py", {"--out=" + figure.string(), "--", csv.string()});
}

int tables_command(const std::vector<std::string>& arguments) {
    std::vector<std::string> handed_on = arguments;
    for (std::string& argument : handed_on)  // the script compares what is kept with the estimators of this program
        if (argument == "--check") argument += "=" + std::to_string(estimator_version);
    return run_script("figures/tables.py", handed_on);
}

int tradeoff_command(const TradeoffOptions& options) {
    const StudyTables tables = read_study_tables(options.results);
    PrimaryComparisons error = primary_of(tables.manifest);
    if (!options.metric.empty()) error.metric = options.metric;
    if (!options.mask.empty()) error.mask = options.mask;
    if (!options.target.empty()) error.target = options.target;
    if (options.margin > 0) error.margin = options.margin;
    std::vector<double> costs = options.times;
    std::ranges::sort(costs);
    const Tradeoff found = tradeoff_of(tables, {.error = error,
                                                .cost = options.cost,
                                                .baseline = options.baseline,
                                                .costs = costs,
                                                .left_out = options.left_out});
    const std::filesystem::path out = options.out.empty() ? path_inside(options.results, "tradeoff") : options.out;
    create_folder(out);
    write_rows(out / "pairs.csv", found.pairs);
    write_rows(out / "front.csv", found.front);
    write_rows(out / "across.csv", found.across);
    write_rows(out / "stages.csv", found.changes);
    write_text(out / "frozen.json", nlohmann::json{{"frozen", frozen_json(found.to_freeze)}}.dump(2) + "\n");
    nlohmann::json asked = {{"results", options.results.string()},
                            {"out", out.string()},
                            {"baseline", found.baseline},
                            {"times", costs},
                            {"factors", options.factors},
                            {"target", error.target},
                            {"metric", error.metric},
                            {"mask", error.mask},
                            {"costs", found.kind == CostKind::timed     ? "timed"
                                      : found.kind == CostKind::counted ? "counted"
                                                                        : "estimated"},
                            {"unit", found.unit},
                            {"model_range", model_range_text()},
                            {"model_decides_from", model_decides_from},
                            {"counts_spread", counts_spread},
                            {"refused", nlohmann::json::array()},
                            {"divisors", nlohmann::json::object()},
                            {"chosen", nlohmann::json::array()}};
    for (const auto& [shot, divisor] : found.divisors) asked["divisors"][shot] = column_json(divisor);
    for (const RefusedEstimate& r : found.refused)
        asked["refused"].push_back({{"point", r.point}, {"shots", r.shots}, {"why", r.refusal}});
    for (const ChosenPoint& c : found.chosen)
        asked["chosen"].push_back({{"shot", c.shot},
                                   {"variant", c.variant},
                                   {"cost", c.cost},
                                   {"point", c.point},
                                   {"chosen_on", c.chosen_on},
                                   {"fits", c.fits}});
    write_text(out / "asked.json", asked.dump(1) + "\n");
    return run_script("tradeoff/tradeoff.py", {(out / "asked.json").string()});
}

namespace {

/// The name of a technique of ssrlab, or else its folder, wherever the config lies.
std::string named_in_configs(const VariantConfig& point) {
    if (point.external) return point.variant;
    const VariantEntry& entry = find_variant(point.variant);
    return entry.is_ssrlabs() ? entry.name : entry.folder->path.string();
}

}  // namespace

int tune_command(const TuneOptions& options, const std::vector<std::string>& run_options) {
    using nlohmann::json;
    const Config config = read_config(options.config);
    if (!config.is_tuned) fail(options.config.string(), ": has no 'tune'; `ssrlab run` runs a study");
    if (!config.source["tune"].contains("axes"))
        fail(options.config.string(), ": 'tune' has no 'axes'; it can only be extended");
    const std::filesystem::path out = options.out.empty() ? default_results(options.config) : options.out;
    const json rules = tuning_of(config);
    if (rules["is_estimated"]) find_chip(rules["time"]);  // or says why it cannot be asked
    json points = json::array();
    for (const VariantConfig& v : config.variants)
        points.push_back({{"variant", named_in_configs(v)},
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
         rules.contains("program") ? json::object() : config_schema(config.variants.front().variant)["properties"]},
        {"folder", std::filesystem::absolute(options.config).parent_path().string()}};
    create_folder(out);
    write_text(out / "tune.json", asked.dump(1) + "\n");  // without comments, which Python does not read
    std::vector<std::string> arguments = {"--out=" + out.string(), (out / "tune.json").string(), "--",
                                          this_program().string()};
    arguments.insert(arguments.end(), run_options.begin(), run_options.end());
    return run_script("tune/tune.py", arguments);
}
