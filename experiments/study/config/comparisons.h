#pragma once
#include "experiments/study/config/config.h"

#include <string>
#include <vector>

/// Finds the partner of each point with PointConfig::against among all points of the study. Fails with Error where no
/// point differs in these values alone; `where` names the config.
void find_against_points(std::vector<PointConfig>& techniques, const std::string& where);

/// The study's points, in the form that verdicts take.
std::vector<ComparedPoint> compared_points(const std::vector<PointConfig>& techniques);

/// A swept point that differs from a baseline of its technique in one parameter. A study may hold dozens: the list of
/// effects shows them, most tables and charts do not.
struct SingleChange {
    std::string technique, point, parameter;
    nlohmann::json value;
};

/// In the order of `techniques`.
std::vector<SingleChange> single_changes(const std::vector<PointConfig>& techniques);
