#include "experiments/results/tradeoff/tradeoff.h"

#include "experiments/results/files/manifest.h"
#include "metrics/statistics/estimates.h"
#include "metrics/statistics/quantiles.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace {

using nlohmann::json;

/// A change with what its intervals are made from.
struct Change {
    ChangeRow row;
    std::string asset;
    bool is_error_significant = false, is_cost_significant = false;
    /// False of estimates that are too close: their model errs in all scenes alike, so that no mean tells more.
    bool may_differ_over_scenes = true;
};

/// `rays: 1 -> 4` of the parameters in which two points differ; empty where that is not one.
std::string change_between(const json& first, const json& second) {
    std::vector<std::string> names;
    const auto add = [&](const json& parameters) {
        for (const auto& [name, value] : parameters.items())
            if (first.value(name, json()) != second.value(name, json()) && std::ranges::count(names, name) == 0)
                names.push_back(name);
    };
    add(first), add(second);
    if (names.size() != 1) return "";
    const auto shown = [&](const json& parameters) {
        const json value = parameters.value(names.front(), json());
        return value.is_string() ? value.get<std::string>() : value.is_null() ? "not set" : value.dump();
    };
    return names.front() + ": " + shown(first) + " -> " + shown(second);
}

std::string verdict_of(const Change& change) {
    const bool errs_less = change.row.error_ratio<1, is_dearer = change.row.cost> 0;
    if (!change.is_cost_significant)
        return !change.is_error_significant ? "not significant"
               : errs_less                  ? "less error, cost not significant"
                                            : "more error, cost not significant";
    if (!change.is_error_significant)
        return is_dearer ? "dearer, error not significant" : "cheaper, error not significant";
    if (errs_less == is_dearer) return is_dearer ? "buys error" : "saves cost";
    return errs_less ? "better in both" : "worse in both";
}

/// Equally probable values of a deviate.
constexpr size_t deviates = 128;
using Deviates = std::array<double, deviates>;

template <class Quantile>
Deviates deviates_of(Quantile quantile) {
    Deviates values;
    for (size_t i = 0; i < deviates; ++i) values[i] = quantile((double(i) + 0.5) / double(deviates));
    return values;
}

/// `normal` with these ends of 95 %, above and below alike where they differ.
Deviates normal_between(const Deviates& normal, double value, double low, double high) {
    const double end = normal_quantile(0.975);
    Deviates moved;
    for (size_t i = 0; i < deviates; ++i)
        moved[i] = value + normal[i] * (normal[i] > 0 ? high - value : value - low) / end;
    return moved;
}

/// Cost for each percent by which the cheaper errs more.
double per_percent(double log_error, double cost) { return std::abs(cost) / (100 * std::expm1(std::abs(log_error))); }

/// Sets cost_per_percent, with an interval of all pairs of both deviates, which are independent.
void set_worth(ChangeRow& row, const Deviates& log_errors, const Deviates& costs) {
    std::vector<double> values;
    for (const double log_error : log_errors)
        for (const double cost : costs) values.push_back(per_percent(log_error, cost));
    const auto end = [&](double probability) -> std::optional<double> {
        const auto at = values.begin() + std::ptrdiff_t(probability * double(values.size() - 1));
        std::ranges::nth_element(values, at);
        return std::isfinite(*at) ? std::optional(*at) : std::nullopt;
    };
    row.cost_per_percent = per_percent(std::log(row.error_ratio), row.cost);
    row.cost_per_percent_low = end(0.025), row.cost_per_percent_high = end(0.975);
}

bool has_worth(const Change& change) {
    return change.row.verdict == "buys error" || change.row.verdict == "saves cost";
}

/// Which of the means differ significantly from 0, adjusted together (Holm), with intervals that agree with it. Where
/// all scenes say the same there is no p, and the mean is exact.
std::vector<bool> judged_together(std::vector<MeanOverScenes*> means) {
    std::vector<bool> is_significant;
    std::vector<double> p;
    for (const MeanOverScenes* m : means) {
        is_significant.push_back(m->low && !m->p && m->value != 0);
        if (m->p) p.push_back(*m->p);
    }
    const std::vector<double> adjusted = holm_adjusted(p);
    for (size_t i = 0, next = 0; i < means.size(); ++i) {
        MeanOverScenes& m = *means[i];
        if (!m.p) continue;
        const double degrees = double(m.scenes) - 2, factor = adjustment_factor(*m.p, adjusted[next], p.size());
        const double wider = student_t_quantile(1 - significance / factor / 2, degrees) /
                             student_t_quantile(1 - significance / 2, degrees);
        m.low = m.value - (m.value - *m.low) * wider, m.high = m.value + (*m.high - m.value) * wider;
        is_significant[i] = adjusted[next++] < significance;
    }
    return is_significant;
}

/// Each change over all scenes in which it was measured by one machine.
std::vector<Change> pooled(const std::vector<Change>& changes) {
    const auto same = [](const Change& a, const Change& b) {
        const auto name = [](const ChangeRow& r) {
            return std::tie(r.machine, r.technique, r.point, r.against_technique, r.against_point, r.change);
        };
        return name(a.row) == name(b.row);
    };
    std::vector<Change> found;
    std::vector<MeanOverScenes> errors, costs;
    for (const Change& change : changes) {
        if (std::ranges::any_of(found, [&](const Change& other) { return same(other, change); })) continue;
        std::vector<ShotValue> log_errors, differences;
        Change& of_all = found.emplace_back(change);
        for (const Change& own : changes)
            if (same(own, change)) {
                of_all.may_differ_over_scenes &= own.may_differ_over_scenes;
                log_errors.push_back({own.asset, std::log(own.row.error_ratio)});
                differences.push_back({own.asset, own.row.cost});
            }
        errors.push_back(mean_over_scenes(log_errors)), costs.push_back(mean_over_scenes(differences));
    }
    std::map<std::string, std::vector<size_t>> of_machine;
    for (size_t i = 0; i < found.size(); ++i) of_machine[found[i].row.machine].push_back(i);
    for (const auto& [machine, family] : of_machine) {
        std::vector<MeanOverScenes*> of_errors, of_costs;
        for (const size_t i : family) of_errors.push_back(&errors[i]), of_costs.push_back(&costs[i]);
        const std::vector<bool> errs = judged_together(of_errors), takes = judged_together(of_costs);
        for (size_t k = 0; k < family.size(); ++k)
            found[family[k]].is_error_significant = errs[k],
            found[family[k]].is_cost_significant = takes[k] && found[family[k]].may_differ_over_scenes;
    }
    for (size_t i = 0; i < found.size(); ++i) {
        const MeanOverScenes &error = errors[i], &cost = costs[i];
        ChangeRow& row = found[i].row;
        row.shot.clear(), row.scenes = error.scenes, row.error_ratio = std::exp(error.value), row.cost = cost.value;
        row.error_low = row.error_high = row.cost_low = row.cost_high = std::nullopt;
        row.cost_per_percent = row.cost_per_percent_low = row.cost_per_percent_high = std::nullopt;
        if (error.low) row.error_low = std::exp(*error.low), row.error_high = std::exp(*error.high);
        row.cost_low = cost.low, row.cost_high = cost.high;
        row.verdict = verdict_of(found[i]);
        if (!has_worth(found[i])) continue;
        const double degrees = double(error.scenes) - 2;
        const Deviates of_t = deviates_of([&](double p) { return student_t_quantile(p, degrees); });
        const auto moved = [&](double value, double standard_error) {
            Deviates values = of_t;
            for (double& v : values) v = value + standard_error * v;
            return values;
        };
        set_worth(row, moved(error.value, error.standard_error), moved(cost.value, cost.standard_error));
    }
    return found;
}

}  // namespace

std::vector<ChangeRow> changes_of(const StudyResults& tables, const PrimaryComparisons& error,
                                  std::span<const FrontRow> front, const std::string& unit,
                                  const std::string& cost_name) {
    using Name = std::tuple<std::string, std::string, std::string>;  // shot, technique, point
    using PairName = std::pair<Name, Name>;
    std::map<Name, const FrontRow*> points;
    for (const FrontRow& p : front) points[{p.shot, p.technique, p.point}] = &p;
    std::map<PointName, json> parameters = parameters_of_points(tables.manifest);
    std::map<PairName, const TimeEffectRow*> time_effects;
    if (unit == unit_of_times)
        for (const TimeEffectRow& t : tables.time_effects)
            if (t.stage == "total")
                time_effects[{{t.shot, t.technique, t.point}, {t.shot, t.against_technique, t.against_point}}] = &t;
    const Deviates normal = deviates_of(normal_quantile);
    const CostKind kind = cost_kind(tables, cost_name);
    std::map<std::string, std::map<PointName, OtherCost>> others;  // by shot
    if (kind != CostKind::timed)
        for (const FrontRow& p : front)
            if (!others.contains(p.shot)) others[p.shot] = other_costs(tables, p.shot, cost_name);

    std::vector<Change> changes;
    std::set<PairName> known;
    for (const EffectRow& e : tables.effects) {
        const PairName names = {{e.shot, e.technique, e.point}, {e.shot, e.against_technique, e.against_point}};
        const auto b = points.find(names.first), a = points.find(names.second);
        if (e.target != error.target || e.metric != error.metric || e.mask != error.mask || !e.ratio || !e.low_holm ||
            !e.high_holm || !(*e.ratio > 0) || e.technique != e.against_technique || a == points.end() ||
            b == points.end() || !(a->second->cost.value_or(0) > 0) || !(b->second->cost.value_or(0) > 0))
            continue;
        const std::string text =
            change_between(parameters[{e.against_technique, e.against_point}], parameters[{e.technique, e.point}]);
        if (text.empty() || !known.insert(names).second) continue;
        const FrontRow& of = *b->second;
        const FrontRow& before = *a->second;
        const double cost = *before.cost, exact = *of.cost / cost;
        Change& change = changes.emplace_back();
        change.asset = asset_of(tables.manifest, e.shot);
        change.is_error_significant = e.verdict == verdict::less || e.verdict == verdict::more;
        ChangeRow& row = change.row;
        row.shot = e.shot, row.machine = of.machine, row.unit = unit, row.change = text;
        row.technique = e.technique, row.point = e.point, row.label = of.label;
        row.against_technique = e.against_technique, row.against_point = e.against_point;
        row.error_ratio = *e.ratio, row.error_low = *e.low_holm, row.error_high = *e.high_holm;
        row.cost_low = row.cost_high = row.cost = (exact - 1) * cost;
        change.is_cost_significant = exact != 1;
        if (kind != CostKind::timed && before.cost_low && of.cost_low) {
            row.cost = *of.cost - cost;
            row.cost_low = *of.cost_low - *before.cost_high, row.cost_high = *of.cost_high - *before.cost_low;
            const std::string decided = cost_verdict(others[e.shot].at({e.technique, e.point}),
                                                     others[e.shot].at({e.against_technique, e.against_point}));
            change.is_cost_significant = decided == verdict::less || decided == verdict::more;
            change.may_differ_over_scenes = kind == CostKind::counted || change.is_cost_significant;
        }
        if (const auto found = time_effects.find(names); found != time_effects.end()) {
            const TimeEffectRow& t = *found->second;
            const bool is_judged = !t.verdict.empty();
            row.cost = (t.ratio - 1) * cost;
            row.cost_low = ((is_judged ? *t.low_holm : t.low) - 1) * cost;
            row.cost_high = ((is_judged ? *t.high_holm : t.high) - 1) * cost;
            change.is_cost_significant = t.verdict == verdict::less || t.verdict == verdict::more;
        }
        row.verdict = verdict_of(change);
        if (has_worth(change))
            set_worth(row, normal_between(normal, std::log(*e.ratio), std::log(*e.low_holm), std::log(*e.high_holm)),
                      normal_between(normal, row.cost, *row.cost_low, *row.cost_high));
    }
    std::map<std::string, size_t> places;
    for (const FrontRow& p : front) places.try_emplace(p.shot, places.size());
    std::ranges::stable_sort(changes, {}, [&](const Change& change) { return places.at(change.row.shot); });
    std::vector<Change> means = pooled(changes);
    std::vector<ChangeRow> rows;
    for (std::vector<Change>* list : {&changes, &means})
        for (Change& change : *list) rows.push_back(std::move(change.row));
    return rows;
}
