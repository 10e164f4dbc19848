#include "experiments/study/table_columns.h"

#include "core/error.h"
#include "core/list_text.h"
#include "core/near_miss.h"
#include "experiments/results/cells/cell.h"
#include "experiments/results/tradeoff/tradeoff.h"
#include "experiments/results/verdicts/effects/effects.h"
#include "experiments/results/verdicts/effects/over_scenes.h"
#include "experiments/results/verdicts/effects/time_effects.h"
#include "experiments/results/verdicts/summary.h"
#include "experiments/study/config/extends.h"
#include "experiments/study/config/points/technique_of.h"
#include "metrics/metric.h"
#include "metrics/temporal.h"
#include "variants/registry.h"

#include <algorithm>
#include <map>
#include <set>

namespace {

using Names = std::vector<std::string>;

/// A row's columns and `others`.
template <class Row>
Names columns_of(Names others = {}) {
    for_each_column<Row>([&](const auto& column) { others.push_back(column.name); });
    return others;
}

struct Source {
    Names selected;  ///< what `where` chooses by
    Names shown;     ///< what rows, columns and means are named by
};

/// By the `of` of a table: experiments/python/ssrlab/tables/cells.py makes its rows of these.
const std::map<std::string, Source>& sources() {
    const auto alike = [](const Names& names) { return Source{names, names}; };
    static const std::map<std::string, Source> all = {
        {"effects", alike(columns_of<EffectRow>())},
        {"results", alike(columns_of<MetricSummary>())},
        {"variance", {columns_of<ResultRow>(), {"shot", "part", "value"}}},
        {"limits", alike(columns_of<MetricSummary>())},
        {"splits", alike(columns_of<SplitRow>({"metric", "value", "low", "high"}))},
        {"times", alike(columns_of<TimeSummary>())},
        {"time_effects", alike(columns_of<TimeEffectRow>())},
        {"hits", alike(columns_of<HitRow>())},
        {"costs", alike(columns_of<CostRow>())},
        {"compiled", alike(columns_of<CompiledRow>({"quantity", "value"}))},
        {"estimates", alike(columns_of<EstimateRow>({"quantity", "value"}))},
        {"at_cost", alike(columns_of<AcrossRow>())},
        {"changes", alike(columns_of<ChangeRow>({"quantity", "value", "low", "high"}))},
        {"over_scenes", alike(columns_of<OverScenesRow>())},
        {"agreement", {columns_of<MetricSummary>(), {"shot", "metric", "against", "value"}}},
        {"eye", {columns_of<MetricSummary>(), {"shot", "pair", "metric", "what", "value"}}}};
    return all;
}

Names texts_of(const nlohmann::json& value) {
    if (!value.is_array()) return {value.is_string() ? value.get<std::string>() : value.dump()};
    Names texts;
    for (const nlohmann::json& one : value) texts.push_back(texts_of(one).front());
    return texts;
}

/// What a column can hold, where the study decides that.
std::map<std::string, Names> values_of(const Config& config) {
    std::map<std::string, Names> values = {{"mask", config.masks},
                                           {"target", config.targets},
                                           {"metric", metric_names()},
                                           {"technique", names_of(config.techniques, &PointConfig::technique)}};
    for (const TemporalMetric& metric : temporal_metrics()) values["metric"].push_back(metric.name);
    for (const char* of_splits : {"bias_squared", "variance"}) values["metric"].push_back(of_splits);
    values["mask"].push_back("all");  // of sequences, whatever the study's masks are
    return values;
}

class TableCheck {
public:
    /// `others`: names that rows have besides their columns.
    TableCheck(const Config& config, const Names& others, JsonObject& table)
        : table_(table), source_(sources().at(table.text("of"))), values_(values_of(config)), others_(others) {}

    void run() {
        for (const char* key : {"rows", "columns", "over"})
            if (table_.has(key))
                for (const std::string& name : texts_of(table_.any(key)))
                    check_column(name, source_.shown, table_.at(key) + ": '" + key + "'");
        if (table_.has("where")) {
            const nlohmann::json& where = table_.any("where");
            const JsonObject places = table_.object("where");
            for (const auto& [name, wanted] : where.items()) {
                check_column(name, source_.selected, places.at(name) + ": 'where'");
                check_values(name, wanted, places.at(name) + ": 'where'");
            }
        }
        // The table's columns are the metrics' names then, or what `labels` makes of them.
        if (table_.has("sort") && texts_of(table_.any("columns")) == Names{"metric"} && !table_.has("labels"))
            check_values("metric", table_.any("sort"), table_.at("sort") + ": 'sort'");
    }

private:
    void check_column(const std::string& name, const Names& columns, const std::string& where) const {
        if (std::ranges::count(columns, name) || std::ranges::count(others_, name)) return;
        Names known = columns;
        known.insert(known.end(), others_.begin(), others_.end());
        fail(where, ": '", shortened(name), "' is neither a column of these rows nor a parameter",
             suggestion(name, nearest_name(name, known).empty() ? columns : known));
    }

    void check_values(const std::string& column, const nlohmann::json& wanted, const std::string& where) const {
        if (!values_.contains(column)) return;
        for (const std::string& text : texts_of(wanted)) {
            const std::string value = text.substr(text.starts_with("!"));
            if (!std::ranges::count(values_.at(column), value))
                fail(where, ": the study has no ", column, " '", shortened(value), "'",
                     suggestion(value, values_.at(column)));
        }
    }

    JsonObject& table_;
    const Source& source_;
    std::map<std::string, Names> values_;
    const Names& others_;
};

}  // namespace

void check_table_columns(const Config& config) {
    Names others = {"group", "shot_group"};
    std::set<std::string> techniques;
    for (const PointConfig& v : config.techniques)
        if (techniques.insert(v.technique).second)
            for (const auto made = plain_technique_of(v); const Parameter& p : made->params) others.push_back(p.name);
    const JsonDocument document = read_extended(config.file);
    for (JsonObject& table : JsonObject(document, config.file.string()).objects("tables"))
        TableCheck(config, others, table).run();
}
