#pragma once
#include "experiments/results/files/comparisons.h"

#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

// What is read from manifest.json (experiments/RESULTS.md).

/// What `shots` has of a shot; an empty object where it has nothing.
const nlohmann::json& shot_entry(const nlohmann::json& manifest, const std::string& shot);

/// What a shot's scene shows, or its name where that is not known: scenes of one asset are no independent samples.
std::string asset_of(const nlohmann::json& manifest, const std::string& shot);

/// A rung of a shot's truth ladder (groundtruth/reference/truth_ladder.h): the error that is left there, with its 95 %
/// interval.
struct Rung {
    std::string name;
    double value = 0;
    std::optional<double> low, high;
};
/// Those that have a value of this error.
std::vector<Rung> truth_ladder(const nlohmann::json& manifest, const std::string& shot,
                               const PrimaryComparisons& error);

/// Whether the clock that timed the shot proved itself; false where nothing was timed.
bool is_clock_proven(const nlohmann::json& manifest, const std::string& shot);

/// The values of all parameters of each point.
std::map<PointName, nlohmann::json> parameters_of_points(const nlohmann::json& manifest);

/// The names that the study gave its points.
std::map<PointName, std::string> point_labels(const nlohmann::json& manifest);

/// {name: {"formula", "unit", "better", "doc"}} of all metrics, and of both parts of a squared error: the one source of
/// which values are good, for report, tables and figures.
nlohmann::json metric_descriptions();

/// The A/A floor of a shot, relative to the mean time; none where no point was timed twice.
std::optional<double> aa_floor(const nlohmann::json& manifest, const std::string& shot);

/// How many pairs of copies were timed in a shot.
size_t aa_pair_count(const nlohmann::json& manifest, const std::string& shot);
