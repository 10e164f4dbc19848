#pragma once
#include "experiments/results/files/counts_spread.h"
#include "experiments/results/verdicts/effects/over_scenes.h"
#include "experiments/results/verdicts/study_results.h"

#include <map>
#include <set>
#include <string>

// What can take the place of time: costs that are counted, or a chip's time, which is estimated. Neither has the noise
// of a clock.

enum class CostKind { timed, counted, estimated };

/// Of "", a quantity of costs.csv, or a chip of estimates.csv; fails with Error for what is none of these.
CostKind cost_kind(const StudyResults& tables, const std::string& cost);

/// A cost with what is not known of it.
struct OtherCost {
    double value = 0, low = 0, high = 0;  ///< with its interval of sampling; all alike where it was counted
    double fits_from = 0;                 ///< the least budget that it surely fits ...
    double may_fit_from = 0;              ///< ... and that it may fit
    double decides_from = 1;              ///< by less than this factor it is neither above nor below another
    bool operator==(const OtherCost&) const = default;
};

/// Of two points, one of which draws random numbers, counts of one seed that differ by less say nothing: each may be
/// off by the spread of the seeds.
constexpr double counts_decide_from(std::string_view quantity) { return 1 + 2 * counts_spread_of(quantity); }

/// The points' costs in a shot: sums over their stages of a quantity, or a chip's estimated `total`, microseconds. None
/// for a point whose estimate was refused.
std::map<PointName, OtherCost> other_costs(const StudyResults& tables, const std::string& shot,
                                           const std::string& cost);

/// Which costs less (verdict::less if `a` does, ...). Undecided where the intervals meet, or the values
/// differ by less than either decides from; equal where all numbers are, as those of points with the same code and
/// work.
std::string cost_verdict(const OtherCost& a, const OtherCost& b);

/// Why a chip's time was not estimated for a point in these shots.
struct RefusedEstimate {
    PointName point;
    std::string refusal;
    std::vector<std::string> shots;
};

/// Of the shots that are named; nothing of a cost that is no chip.
std::vector<RefusedEstimate> refused_estimates(const StudyResults& tables, const std::set<std::string>& shots,
                                               const std::string& cost);
