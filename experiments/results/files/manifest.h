#pragma once
#include "experiments/results/files/comparisons.h"

#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

// Readers of manifest.json (experiments/docs/results_folder.md).

/// The member where it is; null where `object` is no object or lacks it. json::value() would copy it: a manifest has
/// hundreds of shots, and readers ask for each once for every row.
const nlohmann::json& member(const nlohmann::json& object, const char* key);

/// The shot's entry in `shots`; an empty object if it has none.
const nlohmann::json& shot_entry(const nlohmann::json& manifest, const std::string& shot);

/// The asset that a shot's scene shows, or the scene's name if unknown. Scenes of one asset are not independent
/// samples.
std::string asset_of(const nlohmann::json& manifest, const std::string& shot);

/// A rung of a shot's truth ladder (groundtruth/reference/truth_ladder.h): its error with a 95 % interval.
struct Rung {
    std::string name;
    double value = 0;
    std::optional<double> low, high;
};
/// The rungs of a shot that have a value of this error.
std::vector<Rung> truth_ladder(const nlohmann::json& manifest, const std::string& shot,
                               const PrimaryComparisons& error);

/// Whether the clock that timed the shot passed its proof; false where nothing was timed.
bool is_clock_proven(const nlohmann::json& manifest, const std::string& shot);

/// The values of all parameters of each point.
std::map<PointName, nlohmann::json> parameters_of_points(const nlohmann::json& manifest);

/// The names that the study gave its points.
std::map<PointName, std::string> point_labels(const nlohmann::json& manifest);

/// {name: {"formula", "unit", "better", "doc"}} of all metrics, and of both parts of a squared error. Report, tables
/// and figures take from here which values are good.
nlohmann::json metric_descriptions();

/// The A/A floor of a shot, relative to the mean time; none where no point was timed twice.
std::optional<double> aa_floor(const nlohmann::json& manifest, const std::string& shot);

/// How many pairs of copies were timed in a shot.
size_t aa_pair_count(const nlohmann::json& manifest, const std::string& shot);
