#pragma once
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

// Which point stands for a technique at a cost. The error that judges a point never chooses it.

/// The point that stands for a technique at a cost in a shot. The order of choice:
///
/// - The study's frozen point for that cost, if there is one.
/// - Among points whose median cost fits, the point of least error in the other scenes: geometric mean over scenes of
///   the ratio to the baseline's error, over the shots in which all of these points have an error.
/// - Without another scene, the point of least error in the shot itself, which this choice flatters.
struct ChosenPoint {
    std::string shot, technique;
    double cost = 0;
    std::string point;      ///< empty where nothing fits
    std::string chosen_on;  ///< "frozen", "other scenes", "this shot", or empty
    std::string fits;       ///< whether it (or the cheapest point) fits: surely, maybe, no (TimeSummary::fits_from)
};

/// A point that was chosen for a technique at a cost on other scenes, before the study's scenes were seen.
struct FrozenPoint {
    double cost = 0;
    std::string technique, point;
    std::string machine = {};  ///< on whose scenes it was chosen; empty if a config names it
};

/// Share of scenes in which a point must keep a budget.
inline constexpr double share_within_budget = 0.9;

/// A study's frozen points, from its manifest. Fails with Error where "frozen" has types that a config may not have.
std::vector<FrozenPoint> frozen_points(const nlohmann::json& manifest);

/// The points in the form of a config's "frozen".
nlohmann::json frozen_json(const std::vector<FrozenPoint>& points);
