#pragma once
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

// Which point stands for a technique at a cost. It is never chosen by the error that it is judged by.

/// The point by which a technique stands at a cost in a shot: the study's frozen one, if it has one for that cost;
/// else, of those whose median cost is within, the one of least error in the other scenes (geometric mean over scenes
/// of the ratio to the baseline's, over the shots in which all that fit have an error). Where there is no other scene
/// it is the one of least error in the shot itself, which is flattered by the choice.
struct ChosenPoint {
    std::string shot, technique;
    double cost = 0;
    std::string point;      ///< empty where nothing fits
    std::string chosen_on;  ///< "frozen", "other scenes", "this shot", or empty
    std::string fits;  ///< whether it, or the technique's cheapest, fits: surely, maybe, no (TimeSummary::fits_from)
};

/// The point that was chosen for a technique at a cost on other scenes, before those of the study were seen.
struct FrozenPoint {
    double cost = 0;
    std::string technique, point;
};

/// A budget is kept in nine scenes of ten.
inline constexpr double share_within_budget = 0.9;

/// Those of a study, from its manifest. Fails with Error where its "frozen" is of other types than a config may have.
std::vector<FrozenPoint> frozen_points(const nlohmann::json& manifest);

/// The "frozen" of a config.
nlohmann::json frozen_json(const std::vector<FrozenPoint>& points);
