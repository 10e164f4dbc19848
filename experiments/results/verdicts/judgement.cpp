#include "experiments/results/verdicts/judgement.h"

#include "core/error.h"
#include "experiments/results/cells/cell.h"
#include "experiments/results/cells/reference_noise.h"
#include "experiments/results/verdicts/power.h"

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
double detectable_ratio(const EffectRow& row) {
    const ComparedRatio ratio{*row.low, *row.high, double((row.seeds > 1 ? row.seeds : noise_groups) - 1)};
    return std::exp(effects_seen(ratio.degrees, judge_significance, 0.95) * ratio.standard_error());
}

std::string verdict_at(const PairP& p, double ratio) {
    return p.different < judge_significance ? (ratio > 1 ? judgement::worse : judgement::better)
           : p.beyond < judge_significance  ? judgement::equivalent
                                            : judgement::undecided;
}

}  // namespace

Judgement judge_effects(std::span<const EffectRow> effects, const PrimaryComparisons& primary, const PointName& point,
                        const PointName& against) {
    const auto rows = rows_of_shots(effects, primary, point, against);
    if (rows.empty()) fail("no view has an error of both: ", primary.metric, " of ", primary.mask, " pixels");
    std::vector<double> different, beyond;
    for (const auto& [shot, row] : rows) {
        if (!row->p || !row->ratio || !row->low || !row->high || row->verdict.empty())
            fail(shot, ": whether ", primary.metric, " of ", primary.mask,
                 " pixels changed cannot be decided: ", row->interval);
        different.push_back(*row->p), beyond.push_back(row->p_equivalent.value_or(1));
    }
    different = holm_adjusted(different), beyond = holm_adjusted(beyond);
    Judgement judged{.views = {}, .verdict = judgement::equivalent};
    size_t i = 0;
    for (const auto& [shot, row] : rows) {
        const PairP p = {different[i], beyond[i]};
        ++i;
        judged.views.push_back({.shot = shot,
                                .ratio = *row->ratio,
                                .low = *row->low,
                                .high = *row->high,
                                .p_holm = p.different,
                                .detectable = detectable_ratio(*row),
                                .verdict = verdict_at(p, *row->ratio)});
    }
    for (const char* verdict : {judgement::undecided, judgement::better, judgement::worse})
        if (std::ranges::count(judged.views, verdict, &JudgedView::verdict) > 0) judged.verdict = verdict;
    return judged;
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
