#pragma once
#include "experiments/results/verdicts/effects/over_scenes.h"
#include "experiments/results/verdicts/study_results.h"

#include <string>

/// Two points of a shot compared by one error and one cost: which errs less, which costs less, and whether one
/// dominates.
struct PairRow {
    std::string shot, technique, point, other_technique, other_point;
    std::optional<double> error_p_holm;   ///< of "both err alike", adjusted; none if equal
    std::string error_verdict;            ///< verdict::less if the point errs less
    std::string decided_by;               ///< family that adjusts p: "standings", "effects" or "pairs"
    std::optional<double> cost_p_holm;    ///< of "both cost alike"; none for counted and estimated costs
    std::string cost_verdict;             ///< empty if one has no cost, or no point of the shot was timed twice
    std::string dominates, is_dominated;  ///< "yes", "maybe" or "no"; empty without costs

    COLUMNS(PairRow, shot, technique, point, other_technique, other_point, error_p_holm, error_verdict, decided_by,
            cost_p_holm, cost_verdict, dominates, is_dominated)
};

/// Every pair of points of each shot that are ranked by the error, once. `cost`: see cost_kind(); "": total time of a
/// frame.
///
/// Each pair has one verdict on errors. A point and the best measured one take the verdict of its standing. A
/// comparison that the study asks for takes the verdict of its effect. All other pairs of all shots are a family of
/// their own, with p_by_intervals(), which does not pair seeds and is therefore wider (Holm 1979).
///
/// Times have the same rule: pairs of time_effects.csv are decided there; others by the ratios of the frames in which
/// both were timed, and by the difference of copies of one point (time_ratio()). Counted and estimated costs use
/// cost_verdict(). It decides no pair of estimates closer than model_decides_from, nor of one seed's counts closer than
/// counts_decide_from().
///
/// A point dominates another point that certainly errs more and costs no less, or costs more and errs no less. It may
/// dominate where neither its cost nor its error is certainly larger.
std::vector<PairRow> pairs_of(const StudyResults& tables, const PrimaryComparisons& error,
                              const std::string& cost = "");

/// Sets MetricSummary::dominated of all errors with the mask and target of `primary`: "yes" where another point of the
/// shot dominates it by error and time (PairRow::is_dominated), else "maybe" where one may, else "no". Empty where the
/// point is not ranked or not timed.
void set_dominated(StudyResults& tables, const PrimaryComparisons& primary);
