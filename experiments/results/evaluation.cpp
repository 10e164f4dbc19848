#include "experiments/results/evaluation.h"

#include "experiments/results/files/manifest.h"
#include "experiments/results/tradeoff/pairs.h"
#include "experiments/results/verdicts/standings.h"
#include "experiments/results/verdicts/study_points.h"

#include <algorithm>

void evaluate(StudyResults& study, const std::vector<ComparedPoint>& compared, const PrimaryComparisons& primary) {
    const PointSet not_repeatable = points_not_repeatable(study.manifest);
    study.summary = summarise(study.results, points_without_seeds(study.manifest), study.reference_noise);
    // No interval holds how they scatter from run to run.
    for (MetricSummary& e : study.summary)
        if (not_repeatable.contains({e.technique, e.point})) e.ranked = false;
    set_standings(study.summary, paired_errors(study.results, compared, not_repeatable, study.reference_noise),
                  points_using_scene_data(study.manifest), primary.margin);
    std::map<std::string, double> floors;
    for (const TimeRow& t : study.times)
        if (const auto floor = aa_floor(study.manifest, t.shot)) floors[t.shot] = *floor;
    study.time_summary = summarise(study.times, floors);
    set_fronts(study.summary, study.time_summary, study.costs, study.estimates);
    study.over_scenes = errors_over_scenes(study.summary, study.manifest, primary.margin, compared);

    study.effects = paired_effects(study.results, compared, not_repeatable, study.reference_noise);
    std::ranges::move(split_effects(study.splits, compared, not_repeatable), std::back_inserter(study.effects));
    set_verdicts(study.effects, primary, decided_by_standings(study.summary));
    match_effects(study.summary, study.effects);
    study.time_effects = time_effects(study.times, compared);
    set_time_verdicts(study.time_effects, study.manifest);
    set_dominated(study, primary);
}
