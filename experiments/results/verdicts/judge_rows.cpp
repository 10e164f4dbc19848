#include "experiments/results/verdicts/judge_rows.h"

#include "experiments/results/verdicts/judged_sequences.h"

#include <algorithm>
#include <iterator>

Judgement judge_rows(const MeasuredRows& rows, const std::vector<ComparedPoint>& compared,
                     const PointSet& not_repeatable, const PrimaryComparisons& primary, const PointName& point,
                     const PointName& against, const JudgeLimits& limits) {
    std::vector<EffectRow> effects = paired_effects(rows.results, compared, not_repeatable, rows.reference_noise);
    set_verdicts(effects, primary);
    std::vector<Evidence> evidence = evidence_of_errors(effects, primary, point, against, limits);
    const auto add = [&](std::vector<Evidence> more) { std::ranges::move(more, std::back_inserter(evidence)); };
    add(evidence_of_flicker(effects, rows.results, primary, point, against, limits));
    add(evidence_of_ghosts(rows.results, rows.reference_noise, primary.mask, point, against, limits));
    add(evidence_of_visibility(rows.results, rows.reference_noise, point, against, limits));
    return judge(evidence);
}
