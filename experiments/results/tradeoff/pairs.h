#pragma once
#include "experiments/results/verdicts/effects/over_scenes.h"
#include "experiments/results/verdicts/study_results.h"

#include <string>

/// Two points of a shot by one error and one cost: which errs less, which costs less, and whether one dominates.
struct PairRow {
    std::string shot, technique, point, other_technique, other_point;
    std::optional<double> error_p_holm;   ///< of "both err alike", adjusted; none where they are equal
    std::string error_verdict;            ///< verdict::less if the point errs less, ...
    std::string decided_by;               ///< whose family the p is adjusted for: "standings", "effects" or "pairs"
    std::optional<double> cost_p_holm;    ///< of "both cost alike"; none of counted and estimated costs
    std::string cost_verdict;             ///< empty where one has no cost, or where none of the shot was timed twice
    std::string dominates, is_dominated;  ///< "yes", "maybe" or "no"; empty without costs

    COLUMNS(PairRow, shot, technique, point, other_technique, other_point, error_p_holm, error_verdict, decided_by,
            cost_p_holm, cost_verdict, dominates, is_dominated)
};

/// Every pair of points of each shot that are ranked by the error, once. `cost`: see cost_kind(); "": the total time of
/// a frame.
///
/// A pair has one verdict. That of a point and the best measured one is its standing's; that of a comparison which the
/// study was asked for is its effect's; all others are adjusted as members of the family of all pairs of all shots
/// (p_by_intervals(), which knows no pairs of seeds, and so is the wider one; Holm 1979). Times go likewise: what is in
/// time_effects.csv is decided there, all others by the ratios of the frames that both were timed in, and by what
/// copies of one point differ by (time_ratio()). Counted and estimated costs go by cost_verdict(), which decides no
/// pair of estimates closer than model_decides_from, nor of one seed's counts closer than counts_decide_from().
///
/// A point dominates another that errs more and costs no less, or costs more and errs no less: each of them certain. It
/// may dominate where neither its cost nor its error is certainly the larger one.
std::vector<PairRow> pairs_of(const StudyResults& tables, const PrimaryComparisons& error,
                              const std::string& cost = "");

/// Sets MetricSummary::dominated of all errors with the mask and the target of `primary`: "yes" where some other point
/// of the shot dominates the point by the error and by time (PairRow::is_dominated), else "maybe" where one may, else
/// "no"; empty where the point is not ranked, or was not timed.
void set_dominated(StudyResults& tables, const PrimaryComparisons& primary);
