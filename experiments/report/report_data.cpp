#include "experiments/report/report_data.h"

#include "experiments/gpu_costs/chips/model_range.h"
#include "experiments/gpu_costs/pass_cost.h"
#include "experiments/results/files/counts_spread.h"
#include "experiments/results/files/manifest.h"
#include "metrics/direction.h"
#include "metrics/temporal.h"

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

namespace {

using nlohmann::json;

/// Each text once.
struct Texts {
    std::map<std::string, size_t> index;
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

/// {"columns": names, "texts": those of the columns whose values are indices into the list of texts, "rows": values}.
template <class Row, class Rows>
json table(const Rows& rows, Texts& code) {
    json columns = json::array(), texts = json::array(), values = json::array();
    for_each_column<Row>([&](const auto& column) {
        columns.push_back(column.name);
        if (is_text<decltype(column.member)>) texts.push_back(column.name);
    });
    for (const Row& row : rows) {
        json line = json::array();
        for_each_column<Row>([&](const auto& column) {
            const auto& value = row.*column.member;
            if constexpr (is_text<decltype(column.member)>)
                line.push_back(code(value));
            else
                line.push_back(column_json(value));
        });
        values.push_back(std::move(line));
    }
    return {{"columns", std::move(columns)}, {"texts", std::move(texts)}, {"rows", std::move(values)}};
}

/// As table(), with a column for how far each value is from the best that there is, so that less is better for every
/// metric; null where a value or its metric's direction is missing.
json error_table(const std::vector<MetricSummary>& errors, Texts& code) {
    json all = table<MetricSummary>(errors, code);
    all["columns"].push_back("badness");
    for (size_t i = 0; i < errors.size(); ++i) {
        const std::optional<Better> better = direction_of(errors[i].metric);
        all["rows"][i].push_back(better && errors[i].value ? json(shortfall(*better, *errors[i].value)) : json());
    }
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
    const json texts = {"shot", "technique", "point", "stage"};
    json columns = texts, values = json::array();
    for (const CostQuantity& quantity : cost_quantities) columns.push_back(quantity.name);
    std::map<std::vector<size_t>, size_t> place;
    for (const CostRow& row : costs) {
        const std::vector<size_t> key = {code(row.shot), code(row.technique), code(row.point), code(row.stage)};
        const auto [at, is_new] = place.try_emplace(key, values.size());
        if (is_new) {
            values.push_back(key);
            for (size_t i = 0; i < cost_quantities.size(); ++i) values.back().push_back(0);
        }
        for (size_t i = 0; i < cost_quantities.size(); ++i)
            if (row.quantity == cost_quantities[i].name) values[at->second][key.size() + i] = row.value;
    }
    return {{"columns", columns}, {"texts", texts}, {"rows", std::move(values)}};
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
    std::vector<MetricSummary> errors, frames;
    std::set<std::tuple<std::string, std::string, std::string, std::string>> known_over_frames;
    const auto quantity_of = [](const MetricSummary& e) { return std::tuple(e.shot, e.target, e.metric, e.mask); };
    for (const MetricSummary& e : tables.summary)
        if (e.frame == over_frames) known_over_frames.insert(quantity_of(e));
    for (const MetricSummary& e : tables.summary) {
        if (e.represents_shot)
            errors.push_back(e);
        else if (known_over_frames.contains(quantity_of(e)) && !single_changes.contains({e.technique, e.point}))
            frames.push_back(e);
    }
    json data = {{"errors", error_table(errors, code)},
                 {"frames", table<MetricSummary>(frames, code)},
                 {"splits", table<SplitRow>(tables.splits, code)},
                 {"hits", table<HitRow>(tables.hits, code)},
                 {"costs", cost_table(tables.costs, code)},
                 {"count_spread", 100 * counts_spread},
                 {"compiled", table<CompiledRow>(tables.compiled, code)},
                 {"estimates", table<EstimateRow>(tables.estimates, code)},
                 {"model_range", {{"low", model_range.low}, {"high", model_range.high}, {"text", model_range_text()}}},
                 {"effects", table<EffectRow>(tables.effects, code)},
                 {"time_effects", table<TimeEffectRow>(tables.time_effects, code)},
                 {"times", table<TimeSummary>(tables.time_summary, code)},
                 {"metrics", described_metrics()}};
    if (!stability.rows.empty()) data["stability"] = stability_data(stability, code);
    data["texts"] = std::move(code.list);
    return data;
}
