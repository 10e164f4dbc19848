#pragma once
#include "experiments/evaluation/effects/over_scenes.h"
#include "experiments/evaluation/study_tables.h"

#include <map>
#include <set>
#include <string>

// What can take the place of time: costs that are counted, or a chip's time, which is estimated. Neither has noise.

enum class CostKind { timed, counted, estimated };

/// Of "", a quantity of costs.csv, or a chip of estimates.csv; fails with Error for what is none of these.
CostKind cost_kind(const StudyTables& tables, const std::string& cost);

/// A cost with what is not known of it; all alike where it was counted.
struct OtherCost {
    double value = 0, low = 0, high = 0;
    bool operator==(const OtherCost&) const = default;
};

/// The points' costs in a shot: sums over their stages of a quantity, or a chip's estimated `total`, microseconds. None
/// for a point whose estimate was refused.
std::map<PointName, OtherCost> other_costs(const StudyTables& tables, const std::string& shot, const std::string& cost);

/// Why a chip's time was not estimated for a point in these shots.
struct RefusedEstimate {
    PointName point;
    std::string refusal;
    std::vector<std::string> shots;
};

/// Of the shots that are named; nothing of a cost that is no chip.
std::vector<RefusedEstimate> refused_estimates(const StudyTables& tables, const std::set<std::string>& shots,
                                               const std::string& cost);
