#include "experiments/results/verdicts/judgement.h"

#include "core/error.h"
#include "experiments/results/cells/cell.h"
#include "experiments/results/cells/reference_noise.h"
#include "experiments/results/verdicts/power.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace {

/// By shot: the effect over its frames if there is one.
std::map<std::string, const EffectRow*> rows_of_shots(std::span<const EffectRow> effects,
                                                      const PrimaryComparisons& primary, const PointName& point,
                                                      const PointName& against) {
    std::map<std::string, const EffectRow*> rows;
    for (const EffectRow& r : effects) {
        if (PointName(r.technique, r.point) != point || PointName(r.against_technique, r.against_point) != against ||
            r.metric != primary.metric || r.mask != primary.mask || r.target != primary.target)
            continue;
        const EffectRow*& kept = rows[r.shot];
        if (!kept || r.frame == over_frames) kept = &r;
    }
    return rows;
}

/// From the interval's width, which is Student's on the logarithm; with one image a side it is the reference's noise
/// alone.
double detectable_ratio(const EffectRow& row, double worse_by) {
    const ComparedRatio ratio{*row.low, *row.high, double((row.seeds > 1 ? row.seeds : noise_groups) - 1)};
    return worse_by * std::exp(effects_seen(ratio.degrees, judge_significance, 0.95) * ratio.standard_error());
}

std::string verdict_at(double p_different, double p_equivalent, bool is_more) {
    return p_different < judge_significance    ? (is_more ? judgement::worse : judgement::better)
           : p_equivalent < judge_significance ? judgement::equivalent
                                               : judgement::undecided;
}

std::vector<double> adjusted(const std::vector<Evidence>& evidence, double Evidence::*p) {
    std::vector<double> values;
    for (const Evidence& e : evidence) values.push_back(e.*p);
    return holm_adjusted(values);
}

}  // namespace

Evidence evidence_of_ratio(const EffectRow& row, const char* what, const JudgeLimits& limits, double margin_of_row) {
    const bool is_in_row = limits.most_equivalent() == 1 + margin_of_row;
    return {
        .shot = row.shot,
        .what = what,
        .change = *row.ratio,
        .low = *row.low,
        .high = *row.high,
        .p_different = limits.worse_by > 1 ? row.estimate.p_outside(limits.worse_by) : *row.p,
        .p_equivalent = is_in_row ? row.p_equivalent.value_or(1) : row.estimate.p_beyond(limits.most_equivalent() - 1),
        .detectable = detectable_ratio(row, limits.worse_by),
        .of_light = std::exp(std::max(row.estimate.excess_of_a, row.estimate.excess_of_b))};
}

std::vector<Evidence> evidence_of_errors(std::span<const EffectRow> effects, const PrimaryComparisons& primary,
                                         const PointName& point, const PointName& against, const JudgeLimits& limits) {
    const auto rows = rows_of_shots(effects, primary, point, against);
    if (rows.empty()) fail("no view has an error of both: ", primary.metric, " of ", primary.mask, " pixels");
    std::vector<Evidence> evidence;
    for (const auto& [shot, row] : rows) {
        if (!row->p || !row->ratio || !row->low || !row->high || row->verdict.empty())
            fail(shot, ": whether ", primary.metric, " of ", primary.mask,
                 " pixels changed cannot be decided: ", row->interval);
        evidence.push_back(evidence_of_ratio(*row, judged_number::error, limits, primary.margin));
    }
    return evidence;
}

Judgement judge(const std::vector<Evidence>& evidence) {
    const std::vector<double> different = adjusted(evidence, &Evidence::p_different),
                              equivalent = adjusted(evidence, &Evidence::p_equivalent);
    Judgement judged{.views = {}, .verdict = judgement::equivalent};
    for (size_t i = 0; i < evidence.size(); ++i)
        judged.views.push_back({evidence[i], different[i],
                                verdict_at(different[i], equivalent[i], evidence[i].change > evidence[i].no_change)});
    for (const char* verdict : {judgement::undecided, judgement::better, judgement::worse})
        if (std::ranges::count(judged.views, verdict, &JudgedView::verdict) > 0) judged.verdict = verdict;
    return judged;
}

Judgement judge_effects(std::span<const EffectRow> effects, const PrimaryComparisons& primary, const PointName& point,
                        const PointName& against) {
    return judge(evidence_of_errors(effects, primary, point, against, {.margin = primary.margin}));
}

bool measure_alike(std::span<const ResultRow> rows, const PointName& point, const PointName& against) {
    using Place = std::tuple<std::string, std::string, unsigned, std::string, std::string, std::string>;
    std::map<Place, std::optional<double>> own, other;
    bool has_value = false;
    for (const ResultRow& r : rows) {
        const PointName name(r.technique, r.point);
        if (name != point && name != against) continue;
        (name == point ? own : other)[{r.shot, r.frame, r.seed, r.target, r.metric, r.mask}] = r.value;
        has_value = has_value || r.value;
    }
    return has_value && own == other;
}
