#include "experiments/report/report_data.h"

#include "experiments/gpu_costs/chips/model_range.h"
#include "experiments/gpu_costs/pass_cost.h"
#include "experiments/results/files/counts_spread.h"
#include "experiments/results/files/manifest.h"
#include "metrics/direction.h"
#include "metrics/temporal.h"

#include <algorithm>
#include <map>
#include <ranges>
#include <set>
#include <span>
#include <tuple>
#include <unordered_map>

namespace {

using nlohmann::json;

/// Each text once.
struct Texts {
    std::unordered_map<std::string, size_t> index;
    json list = json::array();

    size_t operator()(const std::string& text) {
        const auto [at, is_new] = index.emplace(text, index.size());
        if (is_new) list.push_back(text);
        return at->second;
    }
};

template <class Member>
constexpr bool is_text = false;
template <class Row>
constexpr bool is_text<std::string Row::*> = true;
template <class Row>
constexpr bool is_text<std::string Row::*const> = true;

/// Equal values as one of them.
json column_values(json::array_t values) {
    const bool are_equal =
        !values.empty() && std::ranges::all_of(values, [&](const json& v) { return v == values[0]; });
    return are_equal ? values[0] : json(std::move(values));
}

/// {"count": of rows, "columns": {name: values}, "texts": names of the columns whose values are indices into the list
/// of texts}. `unread` are columns that the page does not read.
template <class Row, class Rows>
json table(const Rows& rows, Texts& code, std::span<const std::string_view> unread = {}) {
    json columns = json::object(), texts = json::array();
    for_each_column<Row>([&](const auto& column) {
        if (std::ranges::find(unread, column.name) != unread.end()) return;
        if (is_text<decltype(column.member)>) texts.push_back(column.name);
        json::array_t values;
        for (const Row& row : rows) {
            const auto& value = row.*column.member;
            if constexpr (is_text<decltype(column.member)>)
                values.push_back(code(value));
            else
                values.push_back(column_json(value));
        }
        columns[column.name] = column_values(std::move(values));
    });
    return {{"count", std::ranges::distance(rows)}, {"columns", std::move(columns)}, {"texts", std::move(texts)}};
}

constexpr std::string_view unread_of_errors[] = {"value_of_power", "value_of_bounded", "represents_shot",
                                                 "over_best",      "over_best_low",    "over_best_high",
                                                 "p_best",         "p_equivalent",     "dominated"};

/// As table(), with a column for how far each value is from the best that there is, so that less is better for every
/// metric; null where a value or its metric's direction is missing.
template <class Errors>
json error_table(const Errors& errors, Texts& code) {
    json all = table<MetricSummary>(errors, code, unread_of_errors);
    json::array_t badness;
    for (const MetricSummary& e : errors) {
        const std::optional<Better> better = direction_of(e.metric);
        badness.push_back(better && e.value ? json(shortfall(*better, *e.value)) : json());
    }
    all["columns"]["badness"] = column_values(std::move(badness));
    return all;
}

const char* direction_text(Better better) {
    constexpr const char* texts[] = {"Less is better.", "More is better.", "Nearer to 0 is better.",
                                     "Nearer to 1 is better."};
    return texts[size_t(better)];  // in the order of Better
}

json described_metrics() {
    json all = metric_descriptions();
    for (auto& [name, about] : all.items())
        if (const std::optional<Better> better = direction_of(name)) about["direction"] = direction_text(*better);
    return all;
}

/// As table(), with one row for each stage and a column for each quantity; one that a stage lacks is 0.
json cost_table(const std::vector<CostRow>& costs, Texts& code) {
    const std::vector<std::string> texts = {"shot", "technique", "point", "stage"};
    std::map<std::string, json::array_t> values;
    std::map<std::vector<size_t>, size_t> place;
    for (const CostRow& row : costs) {
        const std::vector<size_t> key = {code(row.shot), code(row.technique), code(row.point), code(row.stage)};
        const auto [at, is_new] = place.try_emplace(key, place.size());
        if (is_new) {
            for (size_t i = 0; i < key.size(); ++i) values[texts[i]].push_back(key[i]);
            for (const CostQuantity& quantity : cost_quantities) values[quantity.name].push_back(0);
        }
        if (values.contains(row.quantity)) values[row.quantity][at->second] = row.value;
    }
    json columns = json::object();
    for (auto& [name, column] : values) columns[name] = column_values(std::move(column));
    return {{"count", place.size()}, {"columns", columns}, {"texts", texts}};
}

/// Those of `rows` that compare points of one technique: the page shows no others.
template <class Row>
std::vector<Row> of_one_technique(std::vector<Row> rows) {
    std::erase_if(rows, [](const Row& row) { return row.technique != row.against_technique; });
    return rows;
}

json stability_data(const StabilityResults& tables, Texts& code) {
    json verdicts = json::array(), failures = json::array();
    for (const VerdictName& v : verdict_names()) verdicts.push_back({{"name", v.name}, {"meaning", v.meaning}});
    for (const StageFailure& f : stage_failures(tables)) {
        json explanations = json::array();
        for (const KnownFailure& known : f.known)
            explanations.push_back({{"operation", known.operation}, {"fix", known.fix}});
        failures.push_back({{"technique", f.technique},
                            {"place", f.place},
                            {"points", f.points},
                            {"cases", f.cases},
                            {"nan", f.nan},
                            {"infinite", f.infinite},
                            {"first", f.first},
                            {"unexplained", f.unexplained},
                            {"explanations", explanations},
                            {"is_source", f.is_source()}});
    }
    std::vector<StageRow> stages = tables.stages;
    std::erase_if(stages, [](const StageRow& row) { return row.nan + row.infinite == 0; });
    return {{"lead", stability_lead(tables)},
            {"verdicts", verdicts},  // from the best to the worst; rows have indices into them
            {"failures", failures},
            {"cases", table<StabilityCaseName>(tables.cases, code)},
            {"rows", table<StabilityRow>(tables.rows, code)},
            {"stages", table<StageRow>(stages, code)}};
}

}  // namespace

json report_data(const StudyResults& tables, const StabilityResults& stability, const PointSet& single_changes) {
    Texts code;
    std::vector<const MetricSummary*> errors, frames;
    std::set<std::tuple<std::string, std::string, std::string, std::string>> known_over_frames;
    const auto quantity_of = [](const MetricSummary& e) { return std::tuple(e.shot, e.target, e.metric, e.mask); };
    for (const MetricSummary& e : tables.summary)
        if (e.frame == over_frames) known_over_frames.insert(quantity_of(e));
    for (const MetricSummary& e : tables.summary) {
        if (e.represents_shot)
            errors.push_back(&e);
        else if (known_over_frames.contains(quantity_of(e)) && !single_changes.contains({e.technique, e.point}))
            frames.push_back(&e);
    }
    const auto rows_of = std::views::transform([](const MetricSummary* e) -> const MetricSummary& { return *e; });
    json data = {{"errors", error_table(errors | rows_of, code)},
                 {"frames", table<MetricSummary>(frames | rows_of, code, unread_of_errors)},
                 {"splits", table<SplitRow>(tables.splits, code)},
                 {"hits", table<HitRow>(tables.hits, code)},
                 {"costs", cost_table(tables.costs, code)},
                 {"count_spread", 100 * counts_spread},
                 {"compiled", table<CompiledRow>(tables.compiled, code)},
                 {"estimates", table<EstimateRow>(tables.estimates, code)},
                 {"model_range", {{"low", model_range.low}, {"high", model_range.high}, {"text", model_range_text()}}},
                 {"effects", table<EffectRow>(of_one_technique(tables.effects), code)},
                 {"time_effects", table<TimeEffectRow>(of_one_technique(tables.time_effects), code)},
                 {"times", table<TimeSummary>(tables.time_summary, code)},
                 {"metrics", described_metrics()}};
    if (!stability.rows.empty()) data["stability"] = stability_data(stability, code);
    data["texts"] = std::move(code.list);
    return data;
}
