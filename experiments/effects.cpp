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

/// One quantity of one point: its rows by seed.
using Point = std::pair<std::string, std::string>;
using Seeds = std::map<unsigned, const ResultRow*>;

void set_ratio(EffectRow& row, const Jackknifed& error, const Jackknifed& base_error, bool is_repeatable) {
    if (!(error.value > 0 && base_error.value > 0)) return;
    const RatioEstimate e = jackknifed_ratio(error, base_error);
    row.ratio = e.value;
    if (is_repeatable) row.low = e.low, row.high = e.high, row.p = e.p_value;
}

EffectRow effect(const Seeds& point, const Seeds& baseline, bool is_repeatable) {
    const ResultRow &first = *point.begin()->second, &other = *baseline.begin()->second;
    EffectRow row{first.shot,  first.frame,  first.variant, first.point,   other.variant,
                  other.point, first.target, first.metric,  first.formula, first.mask};
    std::vector<double> errors, base_errors;
    bool has_values = true;
    for (const auto& [seed, r] : point) {
        const auto found = baseline.find(seed);
        if (found == baseline.end()) continue;
        ++row.seeds;
        has_values = has_values && r->value && found->second->value;
        errors.push_back(r->value.value_or(0)), base_errors.push_back(found->second->value.value_or(0));
    }
    if (row.seeds > 0 && has_values)
        set_ratio(row, jackknifed_mean(errors), jackknifed_mean(base_errors), is_repeatable);
    return row;
}

void adjust(std::vector<EffectRow>& effects) {
    std::map<std::tuple<std::string, std::string, std::string>, std::vector<EffectRow*>> families;
    for (EffectRow& e : effects)
        if (e.p) families[{e.target, e.metric, e.mask}].push_back(&e);
    for (auto& [name, family] : families) {
        std::vector<double> p;
        for (const EffectRow* e : family) p.push_back(*e->p);
        const std::vector<double> adjusted = holm_adjusted(p);
        for (size_t i = 0; i < family.size(); ++i) family[i]->p_holm = adjusted[i];
    }
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
    std::vector<EffectRow> effects;
    for (const VariantConfig& baseline : variants) {
        if (!baseline.is_baseline) continue;
        for (const VariantConfig& variant : variants) {
            if (variant.variant == baseline.variant && variant.point == baseline.point) continue;
            const Point name(variant.variant, variant.point), base_name(baseline.variant, baseline.point);
            const bool is_repeatable = !not_repeatable.contains(name) && !not_repeatable.contains(base_name);
            for (const auto& [quantity, points] : table) {
                const auto a = points.find(name), b = points.find(base_name);
                if (a != points.end() && b != points.end())
                    effects.push_back(effect(a->second, b->second, is_repeatable));
            }
        }
    }
    adjust(effects);
    return effects;
}

void write_effects(const std::filesystem::path& folder, std::span<const EffectRow> effects) {
    std::string text =
        "shot,frame,variant,point,against_variant,against_point,target,metric,formula,mask,seeds,ratio,low,high,p,p_"
        "holm\n";
    for (const EffectRow& e : effects)
        text += csv_line(e.shot, e.frame, e.variant, e.point, e.against_variant, e.against_point, e.target, e.metric,
                         e.formula, e.mask, e.seeds, e.ratio, e.low, e.high, e.p, e.p_holm);
    write_text(folder / "effects.csv", text);
}
