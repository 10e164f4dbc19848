#include "experiments/results/verdicts/standings.h"

#include "experiments/results/verdicts/family.h"
#include "experiments/results/verdicts/interval.h"
#include "metrics/direction.h"
#include "metrics/statistics/estimates.h"
#include "metrics/statistics/quantiles.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <sstream>
#include <tuple>

namespace {

/// Half the width of the interval of a row's shortfall on its worse or its better side.
double half_width(const MetricSummary& e, Better better, bool is_worse_side) {
    const double own = shortfall(better, *e.value);
    const double ends[] = {shortfall(better, *e.low), shortfall(better, *e.high)};
    return is_worse_side ? std::max({ends[0], ends[1], own}) - own : own - std::min({ends[0], ends[1], own});
}

/// Sets over_best where the pair has a ratio.
PairP compare(MetricSummary& e, const MetricSummary& best, const PairedErrors& paired, double margin) {
    if (paired) {
        EffectRow asked{.shot = e.shot, .technique = e.technique, .point = e.point};
        asked.against_technique = best.technique, asked.against_point = best.point;
        asked.target = e.target, asked.metric = e.metric, asked.mask = e.mask;
        if (const auto effect = paired(asked); effect && effect->p) {
            e.over_best = effect->ratio, e.over_best_low = effect->low, e.over_best_high = effect->high;
            return {*effect->p, effect->estimate.p_beyond(margin)};
        }
    }
    return p_by_intervals(e, best, margin);
}

/// The ranked points of one shot; the best measured one comes first.
using RankedPoints = std::vector<MetricSummary*>;

/// Those with two ranked points or more, by target, metric and mask, which are families.
std::map<std::array<std::string, 3>, std::vector<RankedPoints>> contests_of(std::span<MetricSummary* const> ranked) {
    std::map<std::array<std::string, 3>, std::map<std::string, RankedPoints>> by_shot;
    for (MetricSummary* e : ranked) by_shot[{e->target, e->metric, e->mask}][e->shot].push_back(e);
    std::map<std::array<std::string, 3>, std::vector<RankedPoints>> families;
    for (auto& [error, shots] : by_shot)
        for (auto& [shot, points] : shots) {
            if (points.size() < 2) continue;
            const Better better = *direction_of(points.front()->metric);
            const auto best = std::ranges::min_element(
                points, {}, [&](const MetricSummary* e) { return shortfall(better, *e->value); });
            std::rotate(points.begin(), best, best + 1);
            families[error].push_back(std::move(points));
        }
    return families;
}

/// By the adjusted p-values.
void set_standing(const RankedPoints& points) {
    bool is_alone = true;
    for (MetricSummary* e : std::span(points).subspan(1)) {
        e->standing = standing::of(*e->p_best, *e->p_equivalent);
        is_alone = is_alone && e->standing == standing::behind;
    }
    points.front()->standing = is_alone ? standing::best : standing::tied;
}

void rank(const std::vector<RankedPoints>& family, const PairedErrors& paired, double margin) {
    std::vector<MetricSummary*> others;
    std::vector<AgainstBest> different;
    std::vector<double> beyond;
    std::vector<size_t> sizes;
    for (const RankedPoints& points : family) {
        for (MetricSummary* e : std::span(points).subspan(1)) {
            const PairP p = compare(*e, *points.front(), paired, margin);
            others.push_back(e), different.push_back({sizes.size(), p.different}), beyond.push_back(p.beyond);
        }
        sizes.push_back(points.size());
    }
    const std::vector<double> p_best = adjusted_for_choice(different, sizes), p_equivalent = holm_adjusted(beyond);
    for (size_t i = 0; i < others.size(); ++i) others[i]->p_best = p_best[i], others[i]->p_equivalent = p_equivalent[i];
    for (const RankedPoints& points : family) set_standing(points);
}

using Totals = std::map<std::tuple<std::string, std::string, std::string>, double>;  // by shot, technique, point

/// Adds `cost` to the fronts of the rows that no other beats in both.
void add_front(std::span<MetricSummary> errors, const std::string& cost, const Totals& totals) {
    std::map<std::tuple<std::string, std::string, std::string, std::string>,
             std::vector<std::tuple<double, double, MetricSummary*>>>
        contests;
    for (MetricSummary& e : errors)
        if (const auto total = totals.find({e.shot, e.technique, e.point});
            !e.standing.empty() && total != totals.end())
            contests[{e.shot, e.target, e.metric, e.mask}].push_back(
                {total->second, shortfall(*direction_of(e.metric), *e.value), &e});
    for (auto& [name, points] : contests) {
        std::ranges::sort(points);
        double least = INFINITY;
        for (const auto& [spent, error, e] : points)
            if (error < least) e->fronts += (e->fronts.empty() ? "" : " ") + cost, least = error;
    }
}

}  // namespace

PairP p_by_intervals(const MetricSummary& a, const MetricSummary& b, double margin) {
    const Better better = direction_of(a.metric).value_or(Better::lower);
    const double difference = shortfall(better, *a.value) - shortfall(better, *b.value);
    // Of which one side of each counts: as the errors approach each other, or as they part.
    const auto both = [&](bool is_apart) {
        const bool is_a_worse = (difference > 0) == is_apart;
        return std::hypot(half_width(a, better, is_a_worse), half_width(b, better, !is_a_worse));
    };
    const unsigned of_a = a.seed_degrees(), of_b = b.seed_degrees(),
                   least = of_a > 0 && of_b > 0 ? std::min(of_a, of_b) : std::max(of_a, of_b);
    const double degrees = least > 0 ? least : 1e9;  // as good as a normal's
    const double quantile = student_t_quantile(0.975, degrees), closer = both(false) / quantile;
    PairP p;
    if (difference != 0) p.different = closer > 0 ? 2 * student_t_cdf(-std::abs(difference) / closer, degrees) : 0;
    p.beyond = p_beyond_limits(difference, margin * shortfall(better, *b.value),
                               std::max(both(true), both(false)) / quantile, degrees);
    return p;
}

void set_fronts(std::span<MetricSummary> errors, std::span<const TimeSummary> times, std::span<const CostRow> counts,
                std::span<const EstimateRow> estimates) {
    std::map<std::string, Totals> costs;
    for (const TimeSummary& t : times)
        if (t.stage == "total") costs[front::time][{t.shot, t.technique, t.point}] = t.median;
    const std::map<std::string, std::string> cost_of = {{"fetches", front::fetches},
                                                        {"bytes_read", front::bytes},
                                                        {"bytes_written", front::bytes},
                                                        {"operations", front::operations}};
    for (const CostRow& c : counts)
        if (const auto cost = cost_of.find(c.quantity); cost != cost_of.end() && c.stage == "total")
            costs[cost->second][{c.shot, c.technique, c.point}] += double(c.value);
    std::vector<std::string> names = {front::time, front::fetches, front::bytes, front::operations};
    for (const EstimateRow& e : estimates) {
        if (e.stage != "total" || !e.microseconds) continue;
        if (std::ranges::count(names, e.chip) == 0) names.push_back(e.chip);
        costs[e.chip][{e.shot, e.technique, e.point}] = *e.microseconds;
    }
    for (MetricSummary& e : errors) e.fronts.clear();
    for (const std::string& cost : names) add_front(errors, cost, costs[cost]);
}

bool is_on_front(const MetricSummary& error, const std::string& cost) {
    std::istringstream names(error.fronts);
    return std::find(std::istream_iterator<std::string>(names), {}, cost) != std::istream_iterator<std::string>();
}

void set_standings(std::span<MetricSummary> errors, const PairedErrors& paired, const PointSet& without_part,
                   double margin) {
    std::vector<MetricSummary*> ranked;
    for (MetricSummary& e : errors) {
        e.standing.clear();
        e.over_best = e.over_best_low = e.over_best_high = e.p_best = e.p_equivalent = std::nullopt;
        if (e.represents_shot && e.ranked && e.value && e.low && e.high && direction_of(e.metric) &&
            !without_part.contains({e.technique, e.point}))
            ranked.push_back(&e);
    }
    for (const auto& [error, family] : contests_of(ranked)) rank(family, paired, margin);
}

void match_effects(std::span<MetricSummary> errors, std::span<const EffectRow> effects) {
    using Name = std::array<std::string, 6>;  // shot, target, metric, mask, technique, point
    std::map<Name, MetricSummary*> by_name;
    std::vector<MetricSummary*> ranked;
    for (MetricSummary& e : errors)
        if (!e.standing.empty())
            by_name[{e.shot, e.target, e.metric, e.mask, e.technique, e.point}] = &e, ranked.push_back(&e);
    for (const EffectRow& e : effects) {
        if (!e.p_holm) continue;
        const auto a = by_name.find({e.shot, e.target, e.metric, e.mask, e.technique, e.point}),
                   b = by_name.find({e.shot, e.target, e.metric, e.mask, e.against_technique, e.against_point});
        if (a == by_name.end() || b == by_name.end() || bool(a->second->p_best) == bool(b->second->p_best)) continue;
        MetricSummary& behind = *(a->second->p_best ? a : b)->second;
        behind.p_best = std::max(*behind.p_best, *e.p_holm);
        behind.p_equivalent = std::max(*behind.p_equivalent, *e.p_equivalent_holm);
    }
    for (const auto& [error, family] : contests_of(ranked))
        for (const RankedPoints& points : family) set_standing(points);
}

DecidedPair decided_by_standings(std::span<const MetricSummary> errors) {
    using Name = std::tuple<std::string, std::string, std::string, std::string, std::string, std::string>;
    std::map<Name, const MetricSummary*> ranked;
    for (const MetricSummary& e : errors)
        if (!e.standing.empty()) ranked[{e.shot, e.target, e.metric, e.mask, e.technique, e.point}] = &e;
    return [ranked](const EffectRow& e) -> std::optional<PairP> {
        const auto a = ranked.find({e.shot, e.target, e.metric, e.mask, e.technique, e.point}),
                   b = ranked.find({e.shot, e.target, e.metric, e.mask, e.against_technique, e.against_point});
        if (a == ranked.end() || b == ranked.end()) return {};
        // The best measured one is compared with none, and has no p.
        if (bool(a->second->p_best) == bool(b->second->p_best)) return {};
        const MetricSummary& other = *(a->second->p_best ? a : b)->second;
        return PairP{*other.p_best, *other.p_equivalent};
    };
}
