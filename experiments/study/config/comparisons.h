#pragma once
#include "experiments/study/config/config.h"

#include <string>
#include <vector>

/// Finds what each point with PointConfig::against is compared with, wherever in the study it stands. Fails where no
/// point is the same but for these values; `where` names the config.
void find_against_points(std::vector<PointConfig>& techniques, const std::string& where);

/// The study's points, as verdicts know them.
std::vector<ComparedPoint> compared_points(const std::vector<PointConfig>& techniques);

/// A swept point that differs from a baseline of its technique in one parameter. A study may hold dozens: they belong
/// into the list of effects, not into every table and chart.
struct SingleChange {
    std::string technique, point, parameter;
    nlohmann::json value;
};

/// In the order of `techniques`.
std::vector<SingleChange> single_changes(const std::vector<PointConfig>& techniques);
