#include "experiments/results/tradeoff/pairs.h"

#include "experiments/results/files/manifest.h"
#include "experiments/results/tradeoff/other_costs.h"
#include "experiments/results/verdicts/standings.h"
#include "metrics/direction.h"
#include "metrics/statistics/estimates.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace {

using PairName = std::tuple<std::string, PointName, PointName>;
using Rounds = std::map<std::pair<unsigned, unsigned>, double>;  // by seed and frame, ms

PointName name_of(const MetricSummary& e) { return {e.technique, e.point}; }

/// What comparisons say, found whichever way round they are asked for.
template <class Row>
class Decided {
public:
    void add(const Row& row) {
        rows_[{row.shot, {row.technique, row.point}, {row.against_technique, row.against_point}}] = &row;
    }
    /// The row, and whether it is of b / a.
    std::pair<const Row*, bool> find(const std::string& shot, const PointName& a, const PointName& b) const {
        if (const auto found = rows_.find({shot, a, b}); found != rows_.end()) return {found->second, false};
        if (const auto found = rows_.find({shot, b, a}); found != rows_.end()) return {found->second, true};
        return {nullptr, false};
    }

private:
    std::map<PairName, const Row*> rows_;
};

/// The cost of every point of a shot.
struct Costs {
    std::map<PointName, OtherCost> values;
    std::map<PointName, Rounds> rounds;  ///< of times
    bool is_timed = false;
    double floor = 0;  ///< see aa_floor(); 0 of other costs
    size_t aa_pairs = 0;
    bool is_judged = true;  ///< false of times whose noise is unknown
};

Costs costs_of(const StudyResults& tables, const std::string& shot, const std::string& cost) {
    Costs costs;
    if (cost_kind(tables, cost) == CostKind::timed) {
        costs.is_timed = true;
        for (const TimeSummary& t : tables.time_summary)
            if (t.shot == shot && t.stage == "total") costs.values[{t.technique, t.point}] = {t.median, t.low, t.high};
        for (const TimeRow& t : tables.times)
            if (t.shot == shot && t.stage == "total")
                costs.rounds[{t.technique, t.point}][{t.seed, t.frame}] = t.milliseconds;
        const std::optional<double> floor = aa_floor(tables.manifest, shot);
        costs.is_judged = floor.has_value(), costs.floor = floor.value_or(0);
        costs.aa_pairs = aa_pair_count(tables.manifest, shot);
        return costs;
    }
    costs.values = other_costs(tables, shot, cost);
    return costs;
}

/// A pair on its way to a verdict.
struct OpenPair {
    PairRow row;
    const MetricSummary *a, *b;
    PairP p = {};               ///< of the error, not adjusted
    Estimate cost = {1, 1, 1};  ///< of the costs' ratio
    double cost_p = 1;
    bool has_cost = false;
    bool is_timed = false;
    double floor = 0;  ///< see Costs
};

double error_of(const MetricSummary& e) { return shortfall(*direction_of(e.metric), *e.value); }

/// As a ratio that is below 1 where a errs less, also of metrics whose best value is not the least.
double direction_between(const MetricSummary& a, const MetricSummary& b) { return error_of(a) < error_of(b) ? 0.5 : 2; }

void compare_errors(OpenPair& pair, const Decided<EffectRow>& effects, const DecidedPair& standings, double margin) {
    const MetricSummary &a = *pair.a, &b = *pair.b;
    PairRow& row = pair.row;
    const auto same = [](const MetricSummary& x) { return std::tuple(x.value, x.low, x.high, x.seed_deviation); };
    if (same(a) == same(b)) {
        row.error_verdict = verdict::equal;
        return;
    }
    EffectRow asked{.shot = a.shot, .technique = a.technique, .point = a.point};
    asked.against_technique = b.technique, asked.against_point = b.point;
    asked.target = a.target, asked.metric = a.metric, asked.mask = a.mask;
    if (const auto p = standings(asked)) {
        row.error_p_holm = p->different, row.decided_by = "standings";
        row.error_verdict = verdict_of(*p, direction_between(a, b));
        return;
    }
    if (const auto [effect, is_reversed] = effects.find(a.shot, name_of(a), name_of(b));
        effect && !effect->verdict.empty()) {
        row.error_p_holm = effect->p_holm, row.decided_by = "effects";
        row.error_verdict = verdict_of({*effect->p_holm, effect->p_equivalent_holm.value_or(1)},
                                       is_reversed ? 1 / *effect->ratio : *effect->ratio);
        return;
    }
    row.decided_by = "pairs", pair.p = p_by_intervals(a, b, margin);
}

void compare_costs(OpenPair& pair, const Costs& costs, const Decided<TimeEffectRow>& effects) {
    const PointName a = name_of(*pair.a), b = name_of(*pair.b);
    const auto of_a = costs.values.find(a), of_b = costs.values.find(b);
    if (of_a == costs.values.end() || of_b == costs.values.end()) return;
    const OtherCost &cost_a = of_a->second, &cost_b = of_b->second;
    if (!(cost_a.value > 0 && cost_b.value > 0)) return;
    PairRow& row = pair.row;
    if (!costs.is_timed) {
        pair.has_cost = true;
        row.cost_verdict = cost_verdict(cost_a, cost_b);
        return;
    }
    std::vector<double> ratios;
    const auto rounds_a = costs.rounds.find(a), rounds_b = costs.rounds.find(b);
    if (rounds_a != costs.rounds.end() && rounds_b != costs.rounds.end())
        for (const auto& [round, ms] : rounds_a->second)
            if (const auto found = rounds_b->second.find(round);
                found != rounds_b->second.end() && found->second > 0 && ms > 0)
                ratios.push_back(ms / found->second);
    pair.has_cost = costs.is_judged && !ratios.empty();
    if (!pair.has_cost) return;
    pair.cost = median_interval(ratios);
    const auto [effect, is_reversed] = effects.find(pair.a->shot, a, b);
    if (effect && effect->p_holm) {
        row.cost_p_holm = *effect->p_holm;
        row.cost_verdict = verdict_of({*effect->p_holm}, is_reversed ? 1 / effect->ratio : effect->ratio);
        return;
    }
    pair.cost_p = time_ratio(pair.cost, costs.floor, costs.aa_pairs).p_value();
}

bool is_undecided(const std::string& verdict) {
    return verdict == verdict::undecided || verdict == verdict::equivalent;
}

/// Holm over the pairs of all shots that nobody has decided yet, in the family of all pairs: those that standings and
/// effects leave undecided count, too.
void decide(std::vector<OpenPair>& pairs) {
    std::vector<double> different, beyond, costs;
    size_t other_errors = 0, other_costs = 0;
    for (const OpenPair& pair : pairs) {
        if (pair.row.error_verdict.empty())
            different.push_back(pair.p.different), beyond.push_back(pair.p.beyond);
        else
            other_errors += is_undecided(pair.row.error_verdict);
        if (!pair.has_cost) continue;
        if (pair.row.cost_verdict.empty())
            costs.push_back(pair.cost_p);
        else
            other_costs += is_undecided(pair.row.cost_verdict);
    }
    different = holm_adjusted(different, other_errors), beyond = holm_adjusted(beyond, other_errors);
    costs = holm_adjusted(costs, other_costs);
    size_t error = 0, cost = 0;
    for (OpenPair& pair : pairs) {
        PairRow& row = pair.row;
        if (row.error_verdict.empty()) {
            const PairP p = {different[error], beyond[error]};
            row.error_p_holm = p.different, row.error_verdict = verdict_of(p, direction_between(*pair.a, *pair.b));
            ++error;
        }
        if (pair.has_cost && row.cost_verdict.empty()) {
            row.cost_p_holm = costs[cost++];
            row.cost_verdict = verdict_of({*row.cost_p_holm}, pair.cost.value);
        }
    }
}

void set_dominance(OpenPair& pair) {
    if (!pair.has_cost) return;
    const double floor = pair.floor;
    PairRow& row = pair.row;
    const bool is_same_error = row.error_verdict == verdict::equal;
    const bool errs_less = row.error_verdict == verdict::less, errs_more = row.error_verdict == verdict::more;
    const bool is_cheaper = row.cost_verdict == verdict::less, is_dearer = row.cost_verdict == verdict::more;
    // A difference that two copies of one point may have is none.
    const bool is_same_cost = row.cost_verdict == verdict::equal;
    const bool costs_no_more =
                   pair.is_timed ? pair.cost.value <= 1 && pair.cost.high <= 1 + floor : is_cheaper || is_same_cost,
               costs_no_less =
                   pair.is_timed ? pair.cost.value >= 1 && pair.cost.low * (1 + floor) >= 1 : is_dearer || is_same_cost;
    const auto says = [](bool is_certain, bool is_possible) {
        return is_certain ? "yes" : is_possible ? "maybe" : "no";
    };
    row.dominates =
        says((costs_no_more && errs_less) || (is_cheaper && (errs_less || is_same_error)), !is_dearer && !errs_more);
    row.is_dominated =
        says((costs_no_less && errs_more) || (is_dearer && (errs_more || is_same_error)), !is_cheaper && !errs_less);
}

}  // namespace

std::vector<PairRow> pairs_of(const StudyResults& tables, const PrimaryComparisons& error, const std::string& cost) {
    const auto is_of_error = [&](const auto& row) {
        return row.target == error.target && row.metric == error.metric && row.mask == error.mask;
    };
    std::vector<std::string> shots;
    std::map<std::string, std::vector<const MetricSummary*>> ranked;
    for (const MetricSummary& e : tables.summary) {
        if (!is_of_error(e) || e.standing.empty()) continue;
        if (!ranked.contains(e.shot)) shots.push_back(e.shot);
        ranked[e.shot].push_back(&e);
    }
    Decided<EffectRow> effects;
    for (const EffectRow& e : tables.effects)
        if (is_of_error(e)) effects.add(e);
    Decided<TimeEffectRow> time_effects;
    for (const TimeEffectRow& e : tables.time_effects)
        if (e.stage == "total") time_effects.add(e);
    const DecidedPair standings = decided_by_standings(tables.summary);
    std::vector<OpenPair> pairs;
    for (const std::string& shot : shots) {
        const Costs costs = costs_of(tables, shot, cost);
        const std::vector<const MetricSummary*>& points = ranked[shot];
        for (size_t i = 0; i < points.size(); ++i)
            for (size_t k = i + 1; k < points.size(); ++k) {
                OpenPair& pair = pairs.emplace_back(OpenPair{.row = {.shot = shot,
                                                                     .technique = points[i]->technique,
                                                                     .point = points[i]->point,
                                                                     .other_technique = points[k]->technique,
                                                                     .other_point = points[k]->point},
                                                             .a = points[i],
                                                             .b = points[k]});
                pair.is_timed = costs.is_timed, pair.floor = costs.floor;
                compare_errors(pair, effects, standings, error.margin);
                compare_costs(pair, costs, time_effects);
            }
    }
    decide(pairs);
    std::vector<PairRow> rows;
    for (OpenPair& pair : pairs) {
        set_dominance(pair);
        rows.push_back(std::move(pair.row));
    }
    return rows;
}

void set_dominated(StudyResults& tables, const PrimaryComparisons& primary) {
    std::set<std::string> metrics;
    for (const MetricSummary& e : tables.summary)
        if (e.mask == primary.mask && e.target == primary.target && !e.standing.empty()) metrics.insert(e.metric);
    using PointOfShot =
        std::tuple<std::string, std::string, std::string, std::string>;  // metric, shot, technique, point
    std::map<PointOfShot, std::string> found;
    const auto note = [&](PointOfShot point, const std::string& says) {
        std::string& worst = found[std::move(point)];
        if (worst.empty() || says == "yes" || (says == "maybe" && worst == "no")) worst = says;
    };
    for (const std::string& metric : metrics)
        for (const PairRow& pair : pairs_of(tables, {metric, primary.mask, primary.target})) {
            if (pair.dominates.empty()) continue;
            note({metric, pair.shot, pair.technique, pair.point}, pair.is_dominated);
            note({metric, pair.shot, pair.other_technique, pair.other_point}, pair.dominates);
        }
    for (MetricSummary& e : tables.summary) {
        const auto own = found.find({e.metric, e.shot, e.technique, e.point});
        const bool is_asked = e.mask == primary.mask && e.target == primary.target && !e.standing.empty();
        e.dominated = is_asked && own != found.end() ? own->second : "";
    }
}
