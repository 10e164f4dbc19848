#include "experiments/report/report_data.h"

#include "metrics/metric.h"
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

json optional_json(const std::optional<double>& value) { return value ? json(*value) : json(); }

const char* name_of(Better better) {
    switch (better) {
        case Better::lower:
            return "lower";
        case Better::higher:
            return "higher";
        case Better::near_zero:
            return "near_zero";
        case Better::near_one:
            return "near_one";
    }
    return "";
}

json metric_descriptions() {
    json all = json::object();
    const auto describe = [&](const auto& m) {
        all[m.name] = {{"formula", m.formula}, {"unit", m.unit}, {"better", name_of(m.better)}, {"doc", m.doc}};
    };
    for (const Metric& m : all_metrics()) describe(m);
    for (const TemporalMetric& m : temporal_metrics()) describe(m);
    for (const auto& [name, doc] : {std::pair("bias_squared", "what of the squared error all seeds share"),
                                    std::pair("variance", "what of the squared error differs from seed to seed")})
        all[name] = {
            {"formula", "seed_pairs"}, {"unit", "radiance^2"}, {"better", name_of(Better::lower)}, {"doc", doc}};
    return all;
}

using Quantity = std::tuple<std::string, std::string, std::string, std::string>;
Quantity quantity_of(const MetricSummary& e) { return {e.shot, e.target, e.metric, e.mask}; }

std::set<Quantity> quantities_over_frames(std::span<const MetricSummary> errors) {
    std::set<Quantity> found;
    for (const MetricSummary& e : errors)
        if (e.frame == "all") found.insert(quantity_of(e));
    return found;
}

/// Frames of a shot are played in ascending order.
unsigned frame_number(const MetricSummary& e) { return unsigned(std::strtoul(e.frame.c_str(), nullptr, 10)); }

json error_row(const MetricSummary& e, Texts& code) {
    return {code(e.shot),
            code(e.variant),
            code(e.point),
            code(e.target),
            code(e.metric),
            code(e.formula),
            code(e.mask),
            optional_json(e.value),
            optional_json(e.low),
            optional_json(e.high),
            optional_json(e.floor),
            optional_json(e.seed_deviation),
            e.seeds,
            e.is_corrected ? 1 : 0,
            e.pixels,
            e.non_finite,
            e.negative,
            code(e.frame),
            code(e.interval),
            e.holds_all_noise ? 1 : 0,
            optional_json(e.lit_noise)};
}

json hit_row(const HitRow& h, Texts& code) {
    return {code(h.shot),  code(h.frame), code(h.variant),      code(h.point),
            code(h.stage), code(h.mask),  code(h.quantity),     h.seeds,
            h.rays,        h.value,       optional_json(h.low), optional_json(h.high)};
}

json split_row(const SplitRow& s, Texts& code) {
    return {code(s.shot),
            code(s.frame),
            code(s.variant),
            code(s.point),
            code(s.target),
            code(s.mask),
            s.seeds,
            s.mse,
            s.bias_squared,
            optional_json(s.bias_squared_low),
            optional_json(s.bias_squared_high),
            s.variance,
            optional_json(s.variance_low),
            optional_json(s.variance_high)};
}

json effect_row(const EffectRow& e, Texts& code) {
    return {code(e.shot),
            code(e.variant),
            code(e.point),
            code(e.against),
            code(e.against_variant),
            code(e.against_point),
            code(e.target),
            code(e.metric),
            code(e.formula),
            code(e.mask),
            e.seeds,
            optional_json(e.ratio),
            optional_json(e.low),
            optional_json(e.high),
            optional_json(e.p_holm),
            optional_json(e.p),
            code(e.interval),
            e.family == "primary" ? 1 : 0};
}

json time_effect_row(const TimeEffectRow& e, Texts& code) {
    return {code(e.shot),
            code(e.variant),
            code(e.point),
            code(e.against),
            code(e.against_variant),
            code(e.against_point),
            code(e.stage),
            e.rounds,
            e.ratio,
            e.low,
            e.high};
}

json time_row(const TimeSummary& t, Texts& code) {
    return {code(t.shot), code(t.variant), code(t.point), code(t.stage), code(t.clock),
            t.frames,     t.median,        t.low,         t.high};
}

}  // namespace

ReportTables read_report_tables(const std::filesystem::path& folder, const json& manifest) {
    ReportTables tables{.errors = summarise(read_result_rows(folder / "results.csv"), points_without_seeds(manifest)),
                        .splits = {},
                        .hits = {},
                        .effects = {},
                        .time_effects = {},
                        .times = {}};
    // No interval holds how they scatter from run to run.
    const PointSet not_repeatable = points_not_repeatable(manifest);
    for (MetricSummary& e : tables.errors)
        if (not_repeatable.contains({e.variant, e.point})) e.holds_all_noise = false;
    const auto has = [&](const char* file) { return std::filesystem::exists(folder / file); };
    if (has("splits.csv")) tables.splits = read_split_rows(folder / "splits.csv");
    if (has("hits.csv")) tables.hits = read_hit_rows(folder / "hits.csv");
    if (has("effects.csv")) tables.effects = read_effect_rows(folder / "effects.csv");
    if (has("time_effects.csv")) tables.time_effects = read_time_effect_rows(folder / "time_effects.csv");
    if (has("times.csv")) tables.times = summarise(read_time_rows(folder / "times.csv"));
    return tables;
}

std::vector<const MetricSummary*> rows_for_shots(std::span<const MetricSummary> errors) {
    const std::set<Quantity> over_frames = quantities_over_frames(errors);
    std::map<std::string, unsigned> last;
    for (const MetricSummary& e : errors) last[e.shot] = std::max(last[e.shot], frame_number(e));
    std::vector<const MetricSummary*> rows;
    for (const MetricSummary& e : errors)
        if (e.frame == "all" || (frame_number(e) == last[e.shot] && !over_frames.contains(quantity_of(e))))
            rows.push_back(&e);
    return rows;
}

json report_data(const ReportTables& tables, std::span<const SingleChange> changes) {
    Texts code;
    const PointSet singles = points_of(changes);
    const std::set<Quantity> over_frames = quantities_over_frames(tables.errors);
    json errors = json::array(), frames = json::array(), splits = json::array(), hits = json::array(),
         effects = json::array(), time_effects = json::array(), times = json::array(), single = json::array();
    for (const MetricSummary* e : rows_for_shots(tables.errors)) errors.push_back(error_row(*e, code));
    for (const MetricSummary& e : tables.errors)
        if (e.frame != "all" && over_frames.contains(quantity_of(e)) && !singles.contains({e.variant, e.point}))
            frames.push_back(error_row(e, code));
    for (const SplitRow& s : tables.splits) splits.push_back(split_row(s, code));
    for (const HitRow& h : tables.hits) hits.push_back(hit_row(h, code));
    for (const EffectRow& e : tables.effects) effects.push_back(effect_row(e, code));
    for (const TimeEffectRow& e : tables.time_effects) time_effects.push_back(time_effect_row(e, code));
    for (const TimeSummary& t : tables.times) times.push_back(time_row(t, code));
    for (const SingleChange& c : changes)
        single.push_back({{"variant", c.variant}, {"point", c.point}, {"parameter", c.parameter}, {"value", c.value}});
    return {{"texts", std::move(code.list)},
            {"errors", std::move(errors)},
            {"frames", std::move(frames)},
            {"splits", std::move(splits)},
            {"hits", std::move(hits)},
            {"effects", std::move(effects)},
            {"time_effects", std::move(time_effects)},
            {"times", std::move(times)},
            {"single_changes", std::move(single)},
            {"metrics", metric_descriptions()}};
}
