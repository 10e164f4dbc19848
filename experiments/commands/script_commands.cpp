// The commands that are Python scripts: figures, tables, tradeoff, tune.
#include "core/error.h"
#include "core/files.h"
#include "experiments/commands/child_process.h"
#include "experiments/commands/commands.h"
#include "experiments/config/config.h"
#include "experiments/config/config_schema.h"
#include "metrics/estimators.h"

#include <nlohmann/json.hpp>

namespace {

/// Runs a script of experiments/: 0 done, 2 a mistake of the user, else a fault of the machine (3).
int run_script(const std::string& name, const std::vector<std::string>& arguments) {
    std::vector<std::string> command = {SSRLAB_PYTHON, "-B", SSRLAB_SOURCE_DIR "/experiments/" + name};
    command.insert(command.end(), arguments.begin(), arguments.end());
    const int code = run_program(command);
    return code == 0 || code == 2 ? code : 3;
}

void check_results(const std::filesystem::path& results) {
    if (!std::filesystem::exists(results / "manifest.json"))
        fail(results.string(), " is no results folder: it has no manifest.json; `ssrlab run` makes one");
}

}  // namespace

int figures_command(const FiguresOptions& options) {
    check_results(options.results);
    const std::filesystem::path out = options.out.empty() ? options.results / "figures" : options.out;
    std::vector<std::string> arguments = {"--out=" + out.string()};
    if (!options.choice.empty()) arguments.push_back("--choice=" + options.choice.string());
    arguments.insert(arguments.end(), {"--", options.results.string()});
    return run_script("figures/figures.py", arguments);
}

int stability_figure(const std::filesystem::path& csv, const std::filesystem::path& figure) {
    return run_script("figures/stability_figure.py", {"--out=" + figure.string(), "--", csv.string()});
}

int tables_command(const TablesOptions& options) {
    if (options.checks) return run_script("figures/tables.py", {"--check=" + std::to_string(estimator_version)});
    if (options.results.empty()) {
        if (!options.fills) fail("tables of what? Name a results folder, or --fill or --check");
        return run_script("figures/tables.py", {"--fill"});
    }
    check_results(options.results);
    std::vector<std::string> arguments;
    if (options.keeps) arguments.push_back("--keep");
    if (!options.out.empty()) arguments.push_back("--out=" + options.out.string());
    arguments.insert(arguments.end(), {"--", options.results.string()});
    return run_script("figures/tables.py", arguments);
}

int tradeoff_command(const TradeoffOptions& options) {
    check_results(options.results);
    std::vector<std::string> arguments = {options.results.string()};
    const auto add = [&](const std::string& name, const std::string& value) {
        if (!value.empty()) arguments.push_back("--" + name + "=" + value);
    };
    add("out", options.out.string()), add("baseline", options.baseline), add("metric", options.metric);
    add("mask", options.mask), add("target", options.target), add("cost", options.cost);
    const auto add_list = [&](const std::string& name, const std::vector<double>& values) {
        if (!values.empty()) arguments.push_back("--" + name);
        for (const double value : values) arguments.push_back(nlohmann::json(value).dump());
    };
    add_list("times", options.times), add_list("factors", options.factors);
    if (!options.left_out.empty()) arguments.push_back("--leave-out");
    arguments.insert(arguments.end(), options.left_out.begin(), options.left_out.end());
    return run_script("tradeoff/tradeoff.py", arguments);
}

int tune_command(const TuneOptions& options, const std::vector<std::string>& run_options) {
    using nlohmann::json;
    const Config config = read_config(options.config);
    if (!config.is_tuned) fail(options.config.string(), ": has no 'tune'; `ssrlab run` runs a study");
    if (!config.source["tune"].contains("axes"))
        fail(options.config.string(), ": 'tune' has no 'axes'; it is for others to extend");
    const std::filesystem::path out = options.out.empty() ? default_results(options.config) : options.out;
    json points = json::array();
    for (const VariantConfig& v : config.variants)
        points.push_back({{"variant", v.variant},
                          {"preset", v.preset},
                          {"parameters", v.parameters},
                          {"swept", v.swept},
                          {"point", v.point},
                          {"label", v.label},
                          {"baseline", v.is_baseline}});
    const json asked = {
        {"study", config.source},
        {"tune", config.source["tune"]},
        {"points", points},
        {"primary",
         {{"metric", config.primary.metric}, {"mask", config.primary.mask}, {"target", config.primary.target}}},
        {"parameters", config_schema(config.variants.front().variant)["properties"]},
        {"folder", std::filesystem::absolute(options.config).parent_path().string()}};
    std::filesystem::create_directories(out);
    write_text(out / "tune.json", asked.dump(1) + "\n");  // without comments, which Python does not read
    std::vector<std::string> arguments = {"--out=" + out.string(), (out / "tune.json").string(), "--",
                                          std::filesystem::read_symlink("/proc/self/exe").string()};
    arguments.insert(arguments.end(), run_options.begin(), run_options.end());
    return run_script("tune/tune.py", arguments);
}
