#pragma once
#include "core/json.h"

#include <nlohmann/json.hpp>
#include <string>

// Conditions on a value in JSON: a value, an array of values, or an object of `at_least`, `at_most`, `above`, `below`
// and `not`.

/// Fails with Error unless `condition` can apply to values like `sample`. `where` begins the message.
void check_condition(const nlohmann::json& condition, const nlohmann::json& sample, const std::string& where);

/// Whether the value passes a condition that check_condition() let through. Numbers are compared in float32: 0.1 in a
/// condition equals 0.1 in a parameter.
bool holds(const nlohmann::json& condition, const nlohmann::json& value);

// Conditions on several values, by their names: {"dda.stride": {"at_least": 2}, "shot.has_matte": false}.

/// Fails with Error unless all names are among those of `samples`, and each condition can apply to values like its
/// sample. `places` tells where the conditions stand.
void check_conditions(const nlohmann::json& conditions, const nlohmann::json& samples, const JsonObject& places);

bool all_hold(const nlohmann::json& conditions, const nlohmann::json& values);
