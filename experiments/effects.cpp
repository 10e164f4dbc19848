#include "experiments/effects.h"

#include "core/files.h"
#include "experiments/csv.h"
#include "metrics/statistics.h"
#include "metrics/temporal.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <tuple>

namespace {

using Quantity = std::tuple<std::string, std::string, std::string, std::string>;  // shot, target, metric, mask
Quantity quantity_of(const ResultRow& r) { return {r.shot, r.target, r.metric, r.mask}; }

unsigned frame_number(const ResultRow& row) { return row.frame == "all" ? 0 : unsigned(std::stoul(row.frame)); }

/// The rows that speak for their shot.
std::vector<const ResultRow*> chosen_rows(std::span<const ResultRow> rows) {
    std::set<Quantity> over_frames;
    std::map<std::string, unsigned> last;
    for (const ResultRow& r : rows) {
        if (r.frame == "all") over_frames.insert(quantity_of(r));
        last[r.shot] = std::max(last[r.shot], frame_number(r));
    }
    std::vector<const ResultRow*> chosen;
    for (const ResultRow& r : rows)
        if (is_error(r.metric) &&
            (r.frame == "all" || (frame_number(r) == last[r.shot] && !over_frames.contains(quantity_of(r)))))
            chosen.push_back(&r);
    return chosen;
}

using Point = std::pair<std::string, std::string>;  // variant, point
using Points = std::set<Point>;

/// An effect on what two rows of one quantity measure, as yet without numbers.
template <class Row>
EffectRow effect_between(const Row& point, const Row& baseline) {
    return {.shot = point.shot,
            .frame = point.frame,
            .variant = point.variant,
            .point = point.point,
            .against = {},
            .against_variant = baseline.variant,
            .against_point = baseline.point,
            .target = point.target,
            .mask = point.mask};
}

void set_ratio(EffectRow& row, const Jackknifed& error, const Jackknifed& base_error) {
    if (!(error.value > 0 && base_error.value > 0)) return;
    const RatioEstimate e = jackknifed_ratio(error, base_error);
    row.ratio = e.value, row.low = e.low, row.high = e.high, row.p = e.p_value;
}

using Seeds = std::map<unsigned, const ResultRow*>;

std::vector<EffectRow> effects_of(const Seeds& point, const Seeds& baseline) {
    const ResultRow& first = *point.begin()->second;
    EffectRow row = effect_between(first, *baseline.begin()->second);
    row.metric = first.metric, row.formula = first.formula;
    std::vector<double> errors, base_errors;
    bool has_values = true;
    for (const auto& [seed, r] : point) {
        const auto found = baseline.find(seed);
        if (found == baseline.end()) continue;
        ++row.seeds;
        has_values = has_values && r->value && found->second->value;
        errors.push_back(r->value.value_or(0)), base_errors.push_back(found->second->value.value_or(0));
    }
    if (row.seeds > 0 && has_values) set_ratio(row, jackknifed_mean(errors), jackknifed_mean(base_errors));
    return {row};
}

std::vector<EffectRow> effects_of(const SplitRow* point, const SplitRow* baseline) {
    std::vector<size_t> chosen, base_chosen;  // the common seeds, as places among those of either
    for (size_t i = 0; i < point->seed_numbers.size(); ++i) {
        const auto& numbers = baseline->seed_numbers;
        const auto found = std::ranges::find(numbers, point->seed_numbers[i]);
        if (found != numbers.end()) chosen.push_back(i), base_chosen.push_back(size_t(found - numbers.begin()));
    }
    if (chosen.size() < 2) return {};
    std::vector<EffectRow> effects;
    for (const auto& [name, pairs] :
         {std::pair("bias_squared", &SeedPairs::bias_squared), std::pair("variance", &SeedPairs::variance)}) {
        EffectRow& row = effects.emplace_back(effect_between(*point, *baseline));
        row.metric = name, row.formula = "seed_pairs", row.seeds = chosen.size();
        set_ratio(row, jackknifed_pairs(point->pairs.*pairs, chosen),
                  jackknifed_pairs(baseline->pairs.*pairs, base_chosen));
    }
    return effects;
}

void adjust(std::vector<EffectRow>& effects) {
    std::map<std::tuple<bool, std::string, std::string, std::string>, std::vector<EffectRow*>> families;
    for (EffectRow& e : effects)
        if (e.p) families[{e.against == baseline_name, e.target, e.metric, e.mask}].push_back(&e);
    for (auto& [name, family] : families) {
        std::vector<double> p;
        for (const EffectRow* e : family) p.push_back(*e->p);
        const std::vector<double> adjusted = holm_adjusted(p);
        for (size_t i = 0; i < family.size(); ++i) family[i]->p_holm = adjusted[i];
    }
}

/// What a point is compared with, and as what.
struct PointComparison {
    const VariantConfig* point;
    std::string against_variant, against_point, against;
};

std::vector<PointComparison> comparisons_of(const std::vector<VariantConfig>& variants) {
    std::vector<PointComparison> comparisons;
    for (const VariantConfig& baseline : variants) {
        if (!baseline.is_baseline) continue;
        for (const VariantConfig& v : variants)
            if (v.variant != baseline.variant || v.point != baseline.point)
                comparisons.push_back({&v, baseline.variant, baseline.point, baseline_name});
    }
    for (const VariantConfig& v : variants)
        if (!v.against_point.empty()) comparisons.push_back({&v, v.variant, v.against_point, label_of(v.against)});
    return comparisons;
}

/// `table` holds what was measured, by quantity and point.
template <class Measured>
std::vector<EffectRow> effects_in(const std::map<Quantity, std::map<Point, Measured>>& table,
                                  const std::vector<VariantConfig>& variants, const Points& not_repeatable) {
    std::vector<EffectRow> effects;
    for (const PointComparison& c : comparisons_of(variants)) {
        const Point name(c.point->variant, c.point->point), other(c.against_variant, c.against_point);
        const bool is_repeatable = !not_repeatable.contains(name) && !not_repeatable.contains(other);
        for (const auto& [quantity, points] : table) {
            const auto a = points.find(name), b = points.find(other);
            if (a == points.end() || b == points.end()) continue;
            for (EffectRow& e : effects_of(a->second, b->second)) {
                e.against = c.against;
                if (!is_repeatable) e.low = e.high = e.p = std::nullopt;
                effects.push_back(std::move(e));
            }
        }
    }
    adjust(effects);
    return effects;
}

}  // namespace

bool is_error(const std::string& metric) {
    const auto is_lower_better = [&](const auto& table, auto name, auto better) {
        const auto found = std::ranges::find(table, metric, name);
        return found != table.end() && (*found).*better == Better::lower;
    };
    return is_lower_better(all_metrics(), &Metric::name, &Metric::better) ||
           is_lower_better(temporal_metrics(), &TemporalMetric::name, &TemporalMetric::better);
}

std::vector<EffectRow> paired_effects(std::span<const ResultRow> rows, const std::vector<VariantConfig>& variants,
                                      const std::set<std::pair<std::string, std::string>>& not_repeatable) {
    std::map<Quantity, std::map<Point, Seeds>> table;
    for (const ResultRow* r : chosen_rows(rows)) table[quantity_of(*r)][{r->variant, r->point}][r->seed] = r;
    return effects_in(table, variants, not_repeatable);
}

std::vector<EffectRow> split_effects(std::span<const SplitRow> rows, const std::vector<VariantConfig>& variants,
                                     const std::set<std::pair<std::string, std::string>>& not_repeatable) {
    std::map<Quantity, std::map<Point, const SplitRow*>> table;
    for (const SplitRow& r : rows) table[{r.shot, r.target, "", r.mask}][{r.variant, r.point}] = &r;
    return effects_in(table, variants, not_repeatable);
}

void write_effects(const std::filesystem::path& folder, std::span<const EffectRow> effects) {
    std::string text =
        "shot,frame,variant,point,against,against_variant,against_point,target,metric,formula,mask,seeds,"
        "ratio,low,high,p,p_holm\n";
    for (const EffectRow& e : effects)
        text += csv_line(e.shot, e.frame, e.variant, e.point, e.against, e.against_variant, e.against_point, e.target,
                         e.metric, e.formula, e.mask, e.seeds, e.ratio, e.low, e.high, e.p, e.p_holm);
    write_text(folder / "effects.csv", text);
}
