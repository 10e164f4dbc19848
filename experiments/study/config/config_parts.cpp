#include "experiments/study/config/config_parts.h"

#include "core/error.h"
#include "core/list_text.h"
#include "core/near_miss.h"
#include "experiments/gpu_costs/chips/chip_rates.h"
#include "experiments/gpu_costs/pass_cost.h"
#include "experiments/study/config/points/conditions.h"
#include "experiments/study/config/points/design.h"
#include "experiments/study/config/points/read_techniques.h"
#include "experiments/study/config/shots/read_shots.h"
#include "metrics/metric.h"
#include "variants/registry.h"

#include <algorithm>

namespace {

using nlohmann::json;

const std::string milliseconds = "milliseconds";

/// The one point that all others are compared with.
void check_baseline(ConfigObject& study, std::vector<PointConfig>& points) {
    const auto baselines = std::ranges::count_if(points, &PointConfig::is_baseline);
    if (baselines > 1) fail(study.at("techniques"), ": ", baselines, " points are baselines; 'tune' needs exactly one");
    if (baselines == 0) points.front().is_baseline = true;
}

/// One technique, points that run everywhere with the study's seeds, one of them the baseline.
void check_tuned_points(ConfigObject& study, ConfigObject& tune, Config& config) {
    std::vector<PointConfig>& points = config.techniques;
    for (JsonObject& entry : study.elements("techniques"))
        for (const char* key : {"seeds", "only_if", "skip_if", "timing", "against"})
            if (entry.has(key)) fail(entry.at(key), ": '", key, "' is not allowed in a study with 'tune'; remove it");
    std::vector<std::string> names;
    for (const PointConfig& point : points) {
        if (point.technique != points.front().technique)
            fail(study.at("techniques"), ": 'tune' searches one technique; remove '", points.front().technique,
                 "' or '", point.technique, "'");
        names.push_back(point.point);
        if (point.depends_on_seed && point.seeds.size() < 2)
            fail(study.at(study.has("seeds") ? "seeds" : "techniques"), ": '", point.point,
                 "' draws random numbers: a single seed gives no interval; name two seeds or more");
    }
    check_baseline(study, points);
    if (tune.has("start")) tune.known_texts("start", names);
}

Keys axis_keys() {
    const Values ends = range_values(0);
    return joined({{"values", array_of({json::object(), "a value", {}}), none, "Values to try"},
                   {"lin", ends, none, "Range of values"},
                   {"log", ends, none, "Range of values, sampled evenly by the logarithm"}},
                  condition_keys());
}

Keys judge_keys() {
    return {{"shots", list_of_shots(), required, "Shots of the judging scenes"},
            {"seeds", seeds(), otherwise("the study's"), "Seeds in these shots"}};
}

void check_axes(ConfigObject& tune, const ParameterSet& declared) {
    JsonObject axes = tune.plain("axes");
    const json& written = tune["axes"];
    if (written.empty()) fail(axes.where(), ": is empty; name parameters and what to try");
    for (const auto& [name, axis] : written.items()) {
        json plain = axis;
        if (axis.is_object()) {
            ConfigObject object(axes.object(name), axis_keys());
            for (const PointCondition& condition : read_conditions(object, declared))
                for (const auto& [what, test] : condition.tests.items())
                    if (what.starts_with("shot."))
                        fail(object.where(), ": '", what, "': an axis depends on parameters, not on shots");
            plain.erase("only_if"), plain.erase("skip_if");
            if (plain.size() == 1 && plain.contains("values")) plain = json(plain["values"]);
        }
        check_sample_axis(plain, declared, name, axes.at(name));
    }
}

/// A search over the settings of somebody's program, which is compared with points of any techniques.
void check_program(ConfigObject& study, ConfigObject& tune, Config& config) {
    if (tune.texts("program").empty()) fail(tune.at("program"), ": is empty; name a program");
    for (const char* key : {"start", "time", "budgets"})
        if (tune.has(key))
            fail(tune.at(key), ": '", key,
                 "' is not allowed with 'program': the search begins at the program's defaults and measures no times; "
                 "remove it");
    check_baseline(study, config.techniques);
    if (!tune.has("axes")) return;
    JsonObject axes = tune.plain("axes");
    for (const auto& [name, axis] : tune["axes"].items()) {
        if (axis.is_array()) continue;
        ConfigObject object(axes.object(name), axis_keys());
        unsigned kinds = 0;
        for (const char* kind : {"values", "lin", "log"})
            if (object.has(kind)) static_cast<void>(object[kind]), ++kinds;
        if (kinds != 1 || axis.size() != 1)
            fail(object.where(),
                 ": a setting of a program needs exactly one of 'values', 'lin' and 'log', and no conditions");
        object.finish();
    }
}

void check_technique(ConfigObject& study, ConfigObject& tune, Config& config) {
    check_tuned_points(study, tune, config);
    if (tune.has("axes"))  // which one that others extend may leave to them
        check_axes(tune, make_technique(config.techniques.front().technique)->params);
    if (tune["time"] == milliseconds && config.timing.frames == 0)
        fail(
            tune.where(),
            ": no times are measured; set 'frames' of 'timing' to 15 or more, or 'time' to a count (\"operations\") or "
            "a chip (\"navi21\")");
}

}  // namespace

Values names_of_metrics() {
    return some_of(named(one_of(metric_names()), "a metric of one frame from `ssrlab list metrics`"));
}

Keys table_keys() {
    const Values names = some_of(any_text()),
                 name = {{{"type", "string"}, {"pattern", "^[A-Za-z0-9_]+$"}}, "letters, digits and _", {}};
    const Values any_object = {{{"type", "object"}}, "an object", {}};
    return {{"name", name, required, "Name of the table's files"},
            {"caption", any_text(), required, "Text above the table"},
            {"of",
             one_of({"effects", "results", "splits", "times", "time_effects", "hits", "costs", "compiled", "estimates",
                     "limits", "agreement", "eye", "variance", "at_cost", "changes", "over_scenes"}),
             required, "Source of the numbers"},
            {"where", any_object, otherwise("all rows"),
             "Selects rows: from the name of a column to a value or an array of values. The table keeps the order of "
             "such an array. `\"!value\"` leaves rows out"},
            {"rows", names, required,
             "What names the rows of the table: columns of the file, names of parameters, or `group` and `shot_group`, "
             "which are the groups of points and shots, or else technique and scene. Points and shots appear by their "
             "labels"},
            {"columns", names, required, "What names the columns of the table, as for `rows`"},
            {"over", any_text(), otherwise("no mean"),
             "Column over which the cells are averaged, for example `shot`. The mean is geometric and has a range or "
             "an interval"},
            {"sort", any_text(), otherwise("as in the file"), "Column of the table by which its rows are sorted"},
            {"best", one_of({"column", "row"}), otherwise("none is marked"),
             "Marks the best cells of each column or row: bold if best in the shot, italic if tied or equivalent "
             "(`standing` in summary.csv). Only for `results` and `limits`, and without `over`"},
            {"labels", any_object, none,
             "Replaces names in the table: `{\"lobe = normals\": \"normals\"}`; an empty text leaves a name out"}};
}

void check_tables(ConfigObject& study, const Config& config) {
    std::set<std::string> names;
    for (JsonObject& entry : study.elements("tables")) {
        ConfigObject table(std::move(entry), table_keys());
        const auto name = table.get<std::string>("name"), of = table.get<std::string>("of");
        if (!names.insert(name).second) fail(table.where(), ": two tables are called '", name, "'");
        if (of == "costs" && !config.counts_costs)
            fail(table.at("of"), ": the study counts no costs; add \"costs\": true");
        if (of == "compiled" && config.gpu_compilers.empty())
            fail(table.at("of"), ": the study compiles for no GPU; add \"gpu_compilers\": [\"navi21\"]");
        if (of == "estimates" && !(config.counts_costs && !config.gpu_compilers.empty()))
            fail(table.at("of"),
                 ": the study estimates no GPU's times; add \"costs\": true and \"gpu_compilers\": "
                 "[\"navi21\"]");
        if (table.has("best") && of != "results" && of != "limits")
            fail(table.at("best"), ": 'best' is for tables of 'results' and 'limits', which have a standing, not of '",
                 of, "'");
        if (table.has("best") && table.has("over"))
            fail(table.at("best"), ": means over ", table["over"].dump(),
                 " have no 'best'; remove it: `ssrlab tradeoff` compares over scenes");
        if (of == "hits" && !config.hits) fail(table.at("of"), ": the study judges no rays; add \"hits\": {}");
    }
}

Keys frozen_keys() {
    const Values points = {
        {{"type", "object"}, {"additionalProperties", {{"type", "string"}}}}, "an object of texts", {}};
    return {{"cost",
             {{{"type", "number"}, {"exclusiveMinimum", 0}}, "a number above 0", {}},
             required,
             "Cost: milliseconds, or the quantity or estimate of `ssrlab tradeoff --cost`"},
            {"points", points, required, "For each technique, the name of a point"}};
}

void check_frozen(ConfigObject& study, const Config& config) {
    for (JsonObject& entry : study.elements("frozen")) {
        ConfigObject frozen(std::move(entry), frozen_keys());
        frozen.get<double>("cost");
        for (const auto& [technique, point] : frozen["points"].items()) {
            std::vector<std::string> points;
            for (const PointConfig& v : config.techniques)
                if (v.technique == technique) points.push_back(v.point);
            if (points.empty()) fail(frozen.at("points"), ": the study has no technique '", technique, "'");
            if (std::ranges::count(points, point.get<std::string>()) == 0)
                fail(frozen.at("points"), ": the study has no point '", point.get<std::string>(), "' of ", technique,
                     suggestion(point.get<std::string>(), points));
        }
        frozen.finish();
    }
}

Keys tune_keys() {
    std::vector<std::string> times = names_of(cost_quantities, &CostQuantity::name);
    times.insert(times.begin(), milliseconds);
    std::ranges::move(chips_with_rates(), std::back_inserter(times));
    const Values values = array_of({json::object(), "a value", {}});
    const Values axis = either(values, object_of(axis_keys()));
    Values budget = {{{"type", "number"}, {"exclusiveMinimum", 0}}, "a number above 0", {}};
    return {
        {"axes",
         {{{"type", "object"}, {"additionalProperties", axis.schema}}, "an object of axes", {}, {{"type", "object"}}},
         otherwise("required, except in a config that others extend"),
         "For each parameter, what is tried: an array of values, `{\"lin\": [from, to]}`, `{\"log\": [from, to]}`, or "
         "an object with `values`, `lin` or `log` and the conditions `only_if` and `skip_if`. Where conditions exclude "
         "an axis, the parameter keeps its starting value"},
        {"program", some_of(any_text()), none,
         "External program that renders, and its first arguments. The axes are then settings of the program. It runs "
         "only "
         "with `ssrlab tune --allow-program`"},
        {"start", any_text(), otherwise("the baseline"), "Point that the axes change, by its name"},
        {"time", one_of(times), milliseconds,
         "Cost of a point: measured time, a quantity of `costs.csv`, or the estimated total time of a GPU in "
         "`estimates.csv`. Counts and estimates need no quiet machine"},
        {"budgets", named(array_of(budget), "an array of numbers above 0"), json::array({0.5, 1, 2}),
         "Budgets, as multiples of the baseline's cost. For each, the point with the least error is found"},
        {"metrics", names_of_metrics(), otherwise("the study's `primary`"),
         "Error of a point: the geometric mean of its ratio to the baseline's error, over shots and metrics"},
        {"target", one_of(target_names()), otherwise("the study's `primary`"), "Target of that error"},
        {"mask", any_text(), otherwise("the study's `primary`"), "Mask of that error"},
        {"judge", object_of(judge_keys()), otherwise("none: nothing is judged"),
         "Scenes for judging, which the search does not see"},
        {"most_runs", whole(1, 1 << 30), 1000,
         "Largest number of runs of the search. A run is one seed of one point in one shot"},
        {"most_minutes", number(0, 1e7), Default(1e7, "no limit"), "Time limit of the search in minutes"},
        {"batch", whole(1, 256), 8, "Number of points that are proposed together"},
        {"seed", whole(0, 1 << 30), 0, "Seed of the optimiser"}};
}

void check_tune(ConfigObject& study, Config& config) {
    if (!study.has("tune")) return;
    ConfigObject tune(study.plain("tune"), tune_keys());
    config.is_tuned = true;
    if (config.techniques.empty()) return;  // of which read_config() complains
    if (tune.has("program"))
        check_program(study, tune, config);
    else
        check_technique(study, tune, config);
    if (tune.has("metrics")) tune.known_texts("metrics", config.metrics);
    if (tune.has("target")) tune.known_texts("target", config.targets);
    if (tune.has("mask")) tune.known_texts("mask", config.masks);
    if (!tune.has("judge")) return;
    ConfigObject judge = tune.object("judge");
    if (read_shots(judge, study, config.file.parent_path()).empty())
        fail(judge.where(), ": names no shots; add 'shots'");
    read_seeds(judge);
}

json tuning_of(const Config& config) {
    const std::string where = config.file.string();
    const auto start = std::ranges::find_if(config.techniques, &PointConfig::is_baseline);
    json rules = {{"metrics", json::array({config.primary.metric})},
                  {"target", config.primary.target},
                  {"mask", config.primary.mask},
                  {"start", start->point},
                  {"judge", {{"shots", json::array()}}}};
    rules.update(ConfigObject(JsonObject(config.source.at("tune"), where), tune_keys()).values());
    if (rules["metrics"].is_string()) rules["metrics"] = json::array({rules["metrics"]});
    const json seeds = config.source.value("seeds", json(default_seeds));
    if (rules.contains("program")) {
        if (rules["program"].is_string()) rules["program"] = json::array({rules["program"]});
        rules["budgets"] = json::array({1});
    }
    rules["is_estimated"] = chip_rates(rules["time"]).has_value();
    rules["seeds"] = numbers_of(seeds, where);
    rules["judge"]["seeds"] = numbers_of(rules["judge"].value("seeds", seeds), where);
    return rules;
}
