#include "experiments/evaluation/standings.h"

#include "experiments/evaluation/interval.h"
#include "metrics/quantiles.h"
#include "metrics/statistics.h"
#include "metrics/temporal.h"

#include <algorithm>
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

/// The degrees of freedom that the interval's half-width is of; 0: a normal's.
unsigned degrees_of(const MetricSummary& e) {
    const bool is_of_seeds = e.interval.find("seeds") != std::string::npos;
    return is_of_seeds && e.seeds > 1 ? e.seeds - 1 : 0;
}

/// Whether a paired comparison holds the noise of the reference too.
bool holds_all_noise(const EffectRow& effect, const MetricSummary& a, const MetricSummary& b) {
    const bool is_exact = a.floor == 0.0 && b.floor == 0.0;
    return effect.p && (effect.interval == interval::reference_and_seeds || effect.interval == interval::reference ||
                        (effect.interval == interval::seeds && is_exact));
}

/// The p of "no worse than `best`"; sets over_best where the pair has a ratio.
double compare(MetricSummary& e, const MetricSummary& best, const PairedErrors& paired) {
    if (paired) {
        EffectRow asked{.shot = e.shot, .variant = e.variant, .point = e.point};
        asked.against_variant = best.variant, asked.against_point = best.point;
        asked.target = e.target, asked.metric = e.metric, asked.mask = e.mask;
        if (const auto effect = paired(asked); effect && holds_all_noise(*effect, e, best)) {
            e.over_best = effect->ratio, e.over_best_low = effect->low, e.over_best_high = effect->high;
            return *effect->p;
        }
    }
    return p_by_intervals(e, best);
}

void rank(const std::vector<MetricSummary*>& points, const PairedErrors& paired) {
    if (points.size() < 2) return;
    const Better better = *direction_of(points.front()->metric);
    MetricSummary& best =
        **std::ranges::min_element(points, {}, [&](const MetricSummary* e) { return shortfall(better, *e->value); });
    std::vector<MetricSummary*> others;
    std::vector<double> p;
    for (MetricSummary* e : points)
        if (e != &best) others.push_back(e), p.push_back(compare(*e, best, paired));
    const std::vector<double> adjusted = holm_adjusted(p);
    bool is_alone = true;
    for (size_t i = 0; i < others.size(); ++i) {
        const bool is_behind = adjusted[i] < significance;
        others[i]->p_best = adjusted[i];
        others[i]->standing = is_behind ? standing::behind : standing::tied;
        is_alone = is_alone && is_behind;
    }
    best.standing = is_alone ? standing::best : standing::tied;
}

using Totals = std::map<std::tuple<std::string, std::string, std::string>, double>;  // by shot, variant, point

/// Adds `cost` to the fronts of the rows that no other beats in both.
void add_front(std::span<MetricSummary> errors, const std::string& cost, const Totals& totals) {
    std::map<std::tuple<std::string, std::string, std::string, std::string>,
             std::vector<std::tuple<double, double, MetricSummary*>>>
        contests;
    for (MetricSummary& e : errors)
        if (const auto total = totals.find({e.shot, e.variant, e.point}); !e.standing.empty() && total != totals.end())
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

double p_by_intervals(const MetricSummary& a, const MetricSummary& b) {
    const Better better = direction_of(a.metric).value_or(Better::lower);
    const double difference = shortfall(better, *a.value) - shortfall(better, *b.value);
    if (difference == 0) return 1;
    const bool is_a_worse = difference > 0;
    const double both = std::hypot(half_width(a, better, !is_a_worse), half_width(b, better, is_a_worse));
    if (!(both > 0)) return 0;
    const unsigned of_a = degrees_of(a), of_b = degrees_of(b),
                   degrees = of_a > 0 && of_b > 0 ? std::min(of_a, of_b) : std::max(of_a, of_b);
    const double quantile = degrees > 0 ? student_t_quantile(0.975, degrees) : normal_quantile(0.975);
    const double statistic = std::abs(difference) / both * quantile;
    return degrees > 0 ? 2 * student_t_cdf(-statistic, degrees) : std::erfc(statistic / std::sqrt(2.0));
}

void set_fronts(std::span<MetricSummary> errors, std::span<const TimeSummary> times, std::span<const CostRow> counts) {
    std::map<std::string, Totals> costs;
    for (const TimeSummary& t : times)
        if (t.stage == "total") costs[front::time][{t.shot, t.variant, t.point}] = t.median;
    const std::map<std::string, std::string> cost_of = {{"fetches", front::fetches},
                                                        {"bytes_read", front::bytes},
                                                        {"bytes_written", front::bytes},
                                                        {"operations", front::operations}};
    for (const CostRow& c : counts)
        if (const auto cost = cost_of.find(c.quantity); cost != cost_of.end() && c.stage == "total")
            costs[cost->second][{c.shot, c.variant, c.point}] += double(c.value);
    for (MetricSummary& e : errors) e.fronts.clear();
    for (const char* cost : {front::time, front::fetches, front::bytes, front::operations})
        add_front(errors, cost, costs[cost]);
}

bool is_on_front(const MetricSummary& error, const std::string& cost) {
    std::istringstream names(error.fronts);
    return std::find(std::istream_iterator<std::string>(names), {}, cost) != std::istream_iterator<std::string>();
}

void set_standings(std::span<MetricSummary> errors, const PairedErrors& paired, const PointSet& without_part) {
    std::map<std::tuple<std::string, std::string, std::string, std::string>, std::vector<MetricSummary*>> contests;
    for (MetricSummary& e : errors) {
        e.standing.clear();
        e.over_best = e.over_best_low = e.over_best_high = e.p_best = std::nullopt;
        if (e.represents_shot && e.holds_all_noise && e.value && e.low && e.high && direction_of(e.metric) &&
            !without_part.contains({e.variant, e.point}))
            contests[{e.shot, e.target, e.metric, e.mask}].push_back(&e);
    }
    for (const auto& [name, points] : contests) rank(points, paired);
}

DecidedP decided_by_standings(std::span<const MetricSummary> errors) {
    using Name = std::tuple<std::string, std::string, std::string, std::string, std::string, std::string>;
    std::map<Name, const MetricSummary*> ranked;
    for (const MetricSummary& e : errors)
        if (!e.standing.empty()) ranked[{e.shot, e.target, e.metric, e.mask, e.variant, e.point}] = &e;
    return [ranked](const EffectRow& e) -> std::optional<double> {
        const auto a = ranked.find({e.shot, e.target, e.metric, e.mask, e.variant, e.point}),
                   b = ranked.find({e.shot, e.target, e.metric, e.mask, e.against_variant, e.against_point});
        if (a == ranked.end() || b == ranked.end()) return {};
        // The best measured one is compared with none, and has no p.
        if (!a->second->p_best) return b->second->p_best;
        return b->second->p_best ? std::nullopt : a->second->p_best;
    };
}
