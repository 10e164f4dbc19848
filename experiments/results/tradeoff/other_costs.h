#pragma once
#include "experiments/results/files/counts_spread.h"
#include "experiments/results/verdicts/effects/over_scenes.h"
#include "experiments/results/verdicts/study_results.h"

#include <map>
#include <set>
#include <string>

// Costs other than time: counts, or a chip's estimated time. Neither has a clock's noise.

enum class CostKind { timed, counted, estimated };

/// The kind of a cost: "" is time, a quantity of costs.csv is counted, a chip of estimates.csv is estimated. Fails with
/// Error on anything else.
CostKind cost_kind(const StudyResults& tables, const std::string& cost);

/// A cost with its uncertainty.
struct OtherCost {
    double value = 0, low = 0, high = 0;  ///< with the interval from sampling; all equal for counts
    double fits_from = 0;                 ///< the least budget that the cost surely fits
    double may_fit_from = 0;              ///< the least budget that the cost may fit
    double decides_from = 1;              ///< costs within this factor are neither above nor below another
    bool operator==(const OtherCost&) const = default;
};

/// Least decisive ratio of counts of two points, if one draws random numbers: each count of one seed may be off by the
/// spread of the seeds.
constexpr double counts_decide_from(std::string_view quantity) { return 1 + 2 * counts_spread_of(quantity); }

/// The points' costs in a shot: a quantity's sum over their stages, or a chip's estimated `total` in microseconds. None
/// for a point with a refused estimate.
std::map<PointName, OtherCost> other_costs(const StudyResults& tables, const std::string& shot,
                                           const std::string& cost);

/// Which cost is less: verdict::less if `a` is. Undecided where intervals meet or the ratio is below what either
/// decides from. Equal where all numbers are equal, as for points with the same code and work.
std::string cost_verdict(const OtherCost& a, const OtherCost& b);

/// Why a chip's time was not estimated for a point in some shots.
struct RefusedEstimate {
    PointName point;
    std::string refusal;
    std::vector<std::string> shots;
};

/// The refused estimates in `shots`; empty if the cost is not a chip.
std::vector<RefusedEstimate> refused_estimates(const StudyResults& tables, const std::set<std::string>& shots,
                                               const std::string& cost);
