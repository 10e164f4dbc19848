#include "experiments/config/config_parts.h"

#include "core/error.h"
#include "core/gpu/pass_cost.h"
#include "core/near_miss.h"
#include "experiments/config/conditions.h"
#include "experiments/config/config_values.h"
#include "experiments/config/design.h"
#include "experiments/config/read_shots.h"
#include "metrics/metric.h"
#include "variants/registry.h"

#include <algorithm>

namespace {

/// A text, or an array of texts that is not empty.
void check_names(JsonObject& object, const std::string& key) {
    const nlohmann::json& names = object.any(key);
    const auto is_text = [](const nlohmann::json& name) { return name.is_string(); };
    if (is_text(names) || (names.is_array() && !names.empty() && std::ranges::all_of(names, is_text))) return;
    fail(object.at(key), ": '", key, "' must be a text or an array of texts, not ", shown(names));
}

void check_object(JsonObject& object, const std::string& key) {
    if (object.has(key) && !object.any(key).is_object())
        fail(object.at(key), ": '", key, "' must be an object, not ", shown(object.any(key)));
}

/// One variant, points that run everywhere with the study's seeds, one of them the baseline.
void check_tuned_points(JsonObject& object, JsonObject& tune, Config& config) {
    std::vector<VariantConfig>& points = config.variants;
    for (JsonObject& entry : object.objects("variants"))
        for (const char* key : {"seeds", "only_if", "skip_if", "timing", "against"})
            if (entry.has(key)) fail(entry.at(key), ": '", key, "' is not for points of a study with 'tune'");
    std::vector<std::string> names;
    for (const VariantConfig& point : points) {
        if (point.variant != points.front().variant)
            fail(object.at("variants"), ": 'tune' searches one variant, but here are '", points.front().variant,
                 "' and '", point.variant, "'");
        names.push_back(point.point);
        if (point.depends_on_seed && point.seeds.size() < 2)
            fail(object.at(object.has("seeds") ? "seeds" : "variants"), ": '", point.point,
                 "' draws random numbers: a single seed tells no interval; name two seeds or more");
    }
    const auto baselines = std::ranges::count_if(points, &VariantConfig::is_baseline);
    if (baselines > 1) fail(object.at("variants"), ": ", baselines, " points are baselines; 'tune' needs one");
    if (baselines == 0) points.front().is_baseline = true;
    tune.choice("start", names, names.front());
}

/// Axes are arrays of values, {"lin": [from, to]} or {"log": [from, to]}; or an object of `values`, `lin` or `log` with
/// `only_if` and `skip_if`, conditions on parameters.
void check_axes(JsonObject axes, const nlohmann::json& written, const ParameterSet& declared) {
    if (written.empty()) fail(axes.where(), ": is empty; name parameters and what to try");
    for (const auto& [name, axis] : written.items()) {
        nlohmann::json plain = axis;
        if (axis.is_object()) {
            JsonObject object = axes.object(name);
            for (const PointCondition& condition : read_conditions(object, declared))
                for (const auto& [what, test] : condition.tests.items())
                    if (what.starts_with("shot."))
                        fail(object.where(), ": '", what, "': an axis depends on parameters, not on shots");
            plain.erase("only_if"), plain.erase("skip_if");
            if (plain.size() == 1 && plain.contains("values")) plain = nlohmann::json(plain["values"]);
        }
        if (!plain.is_array() && !plain.is_object())
            fail(axes.at(name), ": '", name,
                 "' must be an array of values, {\"lin\": [from, to]} or {\"log\": ", "[from, to]}, not ", shown(axis));
        check_sample_axis(plain, declared, name, axes.at(name));
    }
}

void check_budgets(JsonObject& tune) {
    if (!tune.has("budgets")) return;
    const nlohmann::json& budgets = tune.any("budgets");
    const auto is_positive = [](const nlohmann::json& b) { return b.is_number() && b.get<double>() > 0; };
    if (!budgets.is_array() || budgets.empty() || !std::ranges::all_of(budgets, is_positive))
        fail(tune.at("budgets"), ": 'budgets' must be an array of multiples of the baseline's time, not ",
             shown(budgets));
}

}  // namespace

void check_tables(JsonObject& object, const Config& config) {
    std::set<std::string> names;
    for (JsonObject& table : object.objects("tables")) {
        const std::string name = table.text("name");
        const auto is_plain = [](unsigned char c) { return std::isalnum(c) || c == '_'; };
        if (name.empty() || !std::ranges::all_of(name, is_plain))
            fail(table.at("name"), ": 'name' = \"", name, "\" names files: letters, digits and _ are allowed");
        if (!names.insert(name).second) fail(table.where(), ": two tables are called '", name, "'");
        table.text("caption");
        table.any("of");
        if (table.choice("of", table_sources, "") == "costs" && !config.counts_costs)
            fail(table.at("of"), ": the study counts no costs; add \"costs\": true");
        check_object(table, "where");
        check_names(table, "rows");
        check_names(table, "columns");
        table.text("over", "");
        table.text("sort", "");
        table.choice("best", {"", "column", "row"}, "");
        check_object(table, "labels");
        table.finish();
    }
}

void check_tune(JsonObject& object, Config& config) {
    if (!object.has("tune")) return;
    JsonObject tune = object.object("tune");
    config.is_tuned = true;
    if (config.variants.empty()) return;  // of which read_config() complains
    check_tuned_points(object, tune, config);
    if (tune.has("axes"))  // which one that others extend may leave to them
        check_axes(tune.object("axes"), tune.any("axes"), make_variant(config.variants.front().variant)->params);
    const std::string time = tune.text("time", "milliseconds");
    const bool has_clock = time == "milliseconds";
    std::vector<std::string> counted;
    for (const CostQuantity& quantity : cost_quantities) counted.push_back(quantity.name);
    if (!has_clock && std::ranges::find(counted, time) == counted.end())
        fail(tune.at("time"), ": 'time' = \"", time, "\" is neither \"milliseconds\" nor a count",
             suggestion(time, counted));
    if (has_clock && config.timing.frames == 0)
        fail(tune.where(), ": needs 'timing' of 15 frames or more, or a counted 'time', such as \"operations\"");
    known_names(tune, "metrics", config.metrics, {});
    tune.choice("target", config.targets, config.targets.front());
    tune.choice("mask", config.masks, config.masks.front());
    check_budgets(tune);
    tune.integer("most_runs", 1, 1 << 30, 1000);
    tune.number("most_minutes", 0.0f, 1e7f, 1e7f);
    tune.integer("batch", 1, 256, 8);
    tune.integer("seed", 0, 1 << 30, 0);
    if (tune.has("judge")) {
        JsonObject judge = tune.object("judge");
        if (read_shots(judge, config.file.parent_path()).empty()) fail(judge.where(), ": names no shots to judge on");
        read_seeds(judge);
        judge.finish();
    }
    tune.finish();
}
