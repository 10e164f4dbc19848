#include "experiments/results/verdicts/effects/effects.h"

#include "experiments/results/verdicts/interval.h"
#include "metrics/direction.h"
#include "metrics/statistics/estimates.h"
#include "metrics/temporal.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <set>
#include <tuple>

namespace {

using Quantity = std::tuple<std::string, std::string, std::string, std::string>;  // shot, target, metric, mask
Quantity quantity_of(const ResultRow& r) { return {r.shot, r.target, r.metric, r.mask}; }

using Point = std::pair<std::string, std::string>;  // technique, point

/// Everything about one quantity of one point that its comparisons need.
struct SeedsOfPoint {
    std::map<unsigned, const ResultRow*> seeds;
    const ReferenceNoise* noise = nullptr;
    const SplitRow* split = nullptr;
    bool depends_on_seed = true;
};

/// An effect on what two rows of one quantity measure, as yet without numbers.
template <class Row>
EffectRow effect_between(const Row& point, const Row& baseline) {
    return {.shot = point.shot,
            .frame = point.frame,
            .technique = point.technique,
            .point = point.point,
            .against = {},
            .against_technique = baseline.technique,
            .against_point = baseline.point,
            .target = point.target,
            .mask = point.mask};
}

/// The variance that the reference's noise gives to ln(a / b); see ReferenceNoise. The groups are as many components of
/// one degree of freedom each, of which few may have most of the variance (Satterthwaite 1946).
SharedScatter shared_scatter(const std::vector<float>& sums, double error, const std::vector<float>& base_sums,
                             double base_error) {
    double variance = 0, squares = 0;
    for (size_t g = 0; g < sums.size(); ++g) {
        const double change = sums[g] / error - base_sums[g] / base_error, square = change * change;
        variance += square, squares += square * square;
    }
    if (variance == 0) return {};
    return {.variance = variance, .degrees = variance * variance / squares};
}

/// Adds to what both sides share how the noise of the lit colour may have moved either. It is taken for independent,
/// though both read the same light: what they have in common would cancel.
void add_lit_noise(SharedScatter& shared, const LitNoise& part, double error, const LitNoise& base_part,
                   double base_error) {
    const auto squared = [](double v) { return v * v; };
    const double variance = squared(part.half_width / 1.96 / error) + squared(base_part.half_width / 1.96 / base_error);
    const double total = shared.variance + variance;
    if (variance > 0) {
        // A half-width holds its own Student's t: as if known with many degrees.
        shared.degrees = shared.variance > 0 ? shared.degrees * squared(total / shared.variance) : 1e6;
        shared.variance = total;
    }
    const auto both = [](double a, double b) { return 1 - (1 - a) * (1 - std::clamp(b, 0.0, 0.99)); };
    shared.excess_of_a = both(shared.excess_of_a, part.added / error);
    shared.excess_of_b = both(shared.excess_of_b, base_part.added / base_error);
}

void set_ratio(EffectRow& row, const Jackknifed& error, const Jackknifed& base_error, const SharedScatter& shared) {
    if (!(error.value > 0 && base_error.value > 0)) {
        row.interval = interval::not_positive;
        return;
    }
    const RatioEstimate e = jackknifed_ratio(error, base_error, shared);
    row.ratio = e.value, row.low = e.low, row.high = e.high, row.p = e.p_value;
    row.estimate = e;
}

/// Takes the interval away where it would hold less than it seems to.
void withhold_interval(EffectRow& row, const char* why) {
    row.low = row.high = row.p = std::nullopt;
    row.interval = why;
}

/// The seeds that a comparison is made over: those that both sides have, a side that does not depend on them having
/// all.
std::vector<unsigned> common_seeds(const SeedsOfPoint& point, const SeedsOfPoint& baseline) {
    const SeedsOfPoint& deciding = point.depends_on_seed ? point : baseline;
    std::vector<unsigned> common;
    for (const auto& [seed, row] : deciding.seeds)
        if (!deciding.depends_on_seed || !baseline.depends_on_seed || baseline.seeds.contains(seed)) {
            common.push_back(seed);
            if (!deciding.depends_on_seed) break;  // both: one seed tells all
        }
    return common;
}

/// The row of a seed.
const ResultRow& row_of(const SeedsOfPoint& side, unsigned seed) {
    return side.depends_on_seed ? *side.seeds.at(seed) : *side.seeds.begin()->second;
}

/// Whether the noise of the reference may be in an error: the halves differ, or it is of outliers, which a floor of 0
/// does not exclude, or it is of several references. Flicker is of a technique's own frames.
bool holds_reference_noise(const ResultRow& row) {
    const TemporalMetric* const temporal = find_temporal_metric(row.metric);
    return row.floor > 0.0 || (row.floor && row.metric == "outliers") || (temporal && temporal->is_of_truth);
}

std::vector<EffectRow> effects_of_rows(const SeedsOfPoint& point, const SeedsOfPoint& baseline) {
    const ResultRow& first = *point.seeds.begin()->second;
    EffectRow row = effect_between(first, *baseline.seeds.begin()->second);
    row.metric = first.metric, row.formula = first.formula;
    std::vector<double> errors, base_errors;
    LitNoise lit, base_lit;
    const auto add_light = [](LitNoise& sum, const ResultRow& r) {
        sum.added += r.lit_noise.value_or(0), sum.half_width += r.lit_half_width.value_or(0);
    };
    bool has_values = true;
    for (const unsigned seed : common_seeds(point, baseline)) {
        const ResultRow &a = row_of(point, seed), &b = row_of(baseline, seed);
        has_values = has_values && a.value && b.value;
        errors.push_back(a.value.value_or(0)), base_errors.push_back(b.value.value_or(0));
        add_light(lit, a), add_light(base_lit, b);
    }
    row.seeds = errors.size();
    if (errors.empty() || !has_values) {
        row.interval = interval::no_value;
        return {row};
    }
    const Jackknifed error = jackknifed_mean(errors), base_error = jackknifed_mean(base_errors);
    const bool has_noise = point.noise && baseline.noise && point.noise->sums.size() == baseline.noise->sums.size() &&
                           point.noise->growth.size() == baseline.noise->growth.size(),
               are_positive = error.value > 0 && base_error.value > 0;
    SharedScatter shared;
    if (has_noise && are_positive && !point.noise->growth.empty()) {
        const auto scatter = extrapolated_scatter(point.noise->growth, baseline.noise->growth);
        if (!scatter) {
            row.ratio = error.value / base_error.value, row.interval = interval::no_end;
            return {row};
        }
        shared = *scatter;
    } else if (has_noise) {
        shared = shared_scatter(point.noise->sums, error.value, baseline.noise->sums, base_error.value);
    }
    const bool is_exact = has_noise && shared.variance == 0;
    for (LitNoise* part : {&lit, &base_lit}) part->added /= double(row.seeds), part->half_width /= double(row.seeds);
    // Equal errors of equal noise are of the same pixels, to which the light adds the same.
    const bool are_same_pixels = is_exact && errors == base_errors && lit.added == base_lit.added;
    if (are_positive && !are_same_pixels) add_lit_noise(shared, lit, error.value, base_lit, base_error.value);
    set_ratio(row, error, base_error, shared);
    if (!row.ratio) return {row};
    const bool has_seeds = point.depends_on_seed || baseline.depends_on_seed;
    row.interval = has_seeds ? (has_noise ? interval::reference_and_seeds : interval::seeds) : interval::reference;
    if (has_seeds && row.seeds < 2)
        withhold_interval(row, interval::one_seed);
    else if (!has_seeds && is_exact && !row.low)  // nor has its light any noise
        row.low = row.high = row.ratio, row.p = *row.ratio == 1 ? 1.0 : 0.0;
    else if (!has_noise && (!has_seeds || holds_reference_noise(first)))
        withhold_interval(row, interval::unknown_reference);
    else if (!row.low)
        withhold_interval(row, has_seeds ? interval::too_few_seeds : interval::no_end);
    return {row};
}

/// The seeds of two splits that both have, as places among those of either; a side without seeds has each.
std::pair<std::vector<size_t>, std::vector<size_t>> common_places(const SeedsOfPoint& point,
                                                                  const SeedsOfPoint& baseline) {
    std::vector<size_t> chosen, base_chosen;
    const auto &numbers = point.split->seed_numbers, &base_numbers = baseline.split->seed_numbers;
    if (!point.depends_on_seed || !baseline.depends_on_seed) {
        const size_t count = (point.depends_on_seed ? numbers : base_numbers).size();
        for (size_t i = 0; i < (point.depends_on_seed || baseline.depends_on_seed ? count : 1); ++i)
            chosen.push_back(i), base_chosen.push_back(i);
        return {chosen, base_chosen};
    }
    for (size_t i = 0; i < numbers.size(); ++i) {
        const auto found = std::ranges::find(base_numbers, numbers[i]);
        if (found != base_numbers.end())
            chosen.push_back(i), base_chosen.push_back(size_t(found - base_numbers.begin()));
    }
    return {chosen, base_chosen};
}

/// A point that does not depend on seeds tells the same without any of them.
Jackknifed part_of(const SeedsOfPoint& side, std::vector<double> SeedPairs::*part, std::span<const size_t> chosen) {
    const std::vector<double>& pairs = side.split->pairs.*part;
    if (side.depends_on_seed) return jackknifed_pairs(pairs, chosen);
    return {.value = pairs.front(), .without = std::vector(chosen.size() > 2 ? chosen.size() : 0, pairs.front())};
}

std::vector<EffectRow> effects_of_splits(const SeedsOfPoint& point, const SeedsOfPoint& baseline) {
    const auto [chosen, base_chosen] = common_places(point, baseline);
    const bool has_seeds = point.depends_on_seed || baseline.depends_on_seed;
    if (chosen.size() < (has_seeds ? 2 : 1)) return {};
    std::vector<EffectRow> effects;
    for (const auto& [name, part] :
         {std::pair("bias_squared", &SeedPairs::bias_squared), std::pair("variance", &SeedPairs::variance)}) {
        EffectRow& row = effects.emplace_back(effect_between(*point.split, *baseline.split));
        row.metric = name, row.formula = "seed_pairs", row.seeds = chosen.size();
        const Jackknifed error = part_of(point, part, chosen), base_error = part_of(baseline, part, base_chosen);
        const bool is_bias = part == &SeedPairs::bias_squared;
        const bool has_noise = is_bias && !point.split->reference_noise.empty() &&
                               point.split->reference_noise.size() == baseline.split->reference_noise.size();
        SharedScatter shared;
        if (has_noise)
            shared = shared_scatter(point.split->reference_noise, error.value, baseline.split->reference_noise,
                                    base_error.value);
        const auto lit_part = [](const SplitRow& r) {
            return LitNoise{r.lit_noise.value_or(0), r.lit_half_width.value_or(0)};
        };
        if (is_bias && error.value > 0 && base_error.value > 0)
            add_lit_noise(shared, lit_part(*point.split), error.value, lit_part(*baseline.split), base_error.value);
        set_ratio(row, error, base_error, shared);
        if (!row.ratio) continue;
        row.interval = !has_seeds ? interval::reference : has_noise ? interval::reference_and_seeds : interval::seeds;
        if (!row.low || (has_seeds && chosen.size() < 3))
            withhold_interval(row, interval::too_few_seeds);
        else if (is_bias && !has_noise)
            withhold_interval(row, interval::unknown_reference);
    }
    return effects;
}

/// `count`: of its family.
void judge(EffectRow& e, const PairP& p, size_t count) {
    e.p_holm = p.different, e.p_equivalent_holm = p.beyond, e.verdict = verdict_of(p, *e.ratio);
    const bool is_exact = e.estimate.standard_error == 0;
    const double level = significance / adjustment_factor(*e.p, p.different, count);
    set_adjusted_interval(e, is_exact ? std::pair(*e.low, *e.high) : e.estimate.interval(level));
}

using PointsOfQuantities = std::map<Quantity, std::map<Point, SeedsOfPoint>>;

PointsOfQuantities errors_by_point(std::span<const ResultRow> rows, std::span<const ReferenceNoise> noise) {
    PointsOfQuantities table;
    for (const ResultRow& r : rows)
        if (r.represents_shot && is_error(r.metric)) table[quantity_of(r)][{r.technique, r.point}].seeds[r.seed] = &r;
    for (const ReferenceNoise& n : noise) {
        const auto points = table.find({n.shot, n.target, n.metric, n.mask});
        if (points == table.end()) continue;
        const auto side = points->second.find({n.technique, n.point});
        if (side != points->second.end() && side->second.seeds.begin()->second->frame == n.frame)
            side->second.noise = &n;
    }
    return table;
}

void set_seed_dependence(PointsOfQuantities& table, const std::vector<ComparedPoint>& compared) {
    for (auto& [quantity, points] : table)
        for (const ComparedPoint& v : compared)
            if (const auto found = points.find({v.technique, v.point}); found != points.end())
                found->second.depends_on_seed = v.depends_on_seed;
}

/// `table` holds what was measured, by quantity and point.
std::vector<EffectRow> effects_in(PointsOfQuantities table, const std::vector<ComparedPoint>& compared,
                                  const PointSet& not_repeatable,
                                  std::vector<EffectRow> (*effects_of)(const SeedsOfPoint&, const SeedsOfPoint&)) {
    set_seed_dependence(table, compared);
    std::vector<EffectRow> effects;
    for (const PointComparison& c : comparisons_of(compared)) {
        const Point name(c.point->technique, c.point->point), other(c.baseline->technique, c.baseline->point);
        const bool is_repeatable = !not_repeatable.contains(name) && !not_repeatable.contains(other);
        for (const auto& [quantity, points] : table) {
            const auto a = points.find(name), b = points.find(other);
            if (a == points.end() || b == points.end()) continue;
            for (EffectRow& e : effects_of(a->second, b->second)) {
                e.against = c.against, e.family = "exploratory";
                if (!is_repeatable && e.ratio) withhold_interval(e, interval::not_repeatable);
                effects.push_back(std::move(e));
            }
        }
    }
    return effects;
}

}  // namespace

std::vector<EffectRow> paired_effects(std::span<const ResultRow> rows, const std::vector<ComparedPoint>& compared,
                                      const PointSet& not_repeatable, std::span<const ReferenceNoise> noise) {
    return effects_in(errors_by_point(rows, noise), compared, not_repeatable, effects_of_rows);
}

PairedErrors paired_errors(std::span<const ResultRow> rows, const std::vector<ComparedPoint>& compared,
                           const PointSet& not_repeatable, std::span<const ReferenceNoise> noise) {
    auto table = std::make_shared<PointsOfQuantities>(errors_by_point(rows, noise));
    set_seed_dependence(*table, compared);
    return [table, not_repeatable](const EffectRow& asked) -> std::optional<EffectRow> {
        const auto points = table->find({asked.shot, asked.target, asked.metric, asked.mask});
        if (points == table->end()) return {};
        const Point name(asked.technique, asked.point), other(asked.against_technique, asked.against_point);
        const auto a = points->second.find(name), b = points->second.find(other);
        if (a == points->second.end() || b == points->second.end()) return {};
        EffectRow effect = effects_of_rows(a->second, b->second).front();
        if ((not_repeatable.contains(name) || not_repeatable.contains(other)) && effect.ratio)
            withhold_interval(effect, interval::not_repeatable);
        return effect;
    };
}

std::vector<EffectRow> split_effects(std::span<const SplitRow> rows, const std::vector<ComparedPoint>& compared,
                                     const PointSet& not_repeatable) {
    PointsOfQuantities table;
    for (const SplitRow& r : rows) table[{r.shot, r.target, "", r.mask}][{r.technique, r.point}].split = &r;
    return effects_in(table, compared, not_repeatable, effects_of_splits);
}

void set_verdicts(std::span<EffectRow> effects, const PrimaryComparisons& primary, const DecidedPair& decided) {
    std::map<std::tuple<std::string, std::string, std::string>, std::vector<EffectRow*>> families;
    for (EffectRow& e : effects) {
        const bool is_primary = e.metric == primary.metric && e.mask == primary.mask && e.target == primary.target;
        e.family = is_primary ? "primary" : "exploratory", e.verdict.clear();
        e.p_holm = e.low_holm = e.high_holm = e.p_equivalent = e.p_equivalent_holm = std::nullopt;
        if (!e.p || !e.ratio) continue;
        families[{e.target, e.metric, e.mask}].push_back(&e);
    }
    for (const auto& [error, family] : families) {
        std::vector<double> different, beyond;
        for (EffectRow* e : family) {
            e->p_equivalent = e->estimate.p_beyond(primary.margin);
            different.push_back(*e->p), beyond.push_back(*e->p_equivalent);
        }
        different = holm_adjusted(different), beyond = holm_adjusted(beyond);
        for (size_t i = 0; i < family.size(); ++i) {
            const PairP other = decided ? decided(*family[i]).value_or(PairP{0, 0}) : PairP{0, 0};
            judge(*family[i], {std::max(different[i], other.different), std::max(beyond[i], other.beyond)},
                  family.size());
        }
    }
}
