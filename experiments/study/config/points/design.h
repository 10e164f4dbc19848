#pragma once
#include "core/parameters.h"
#include "experiments/study/config/keys.h"

#include <vector>

/// Limit of points in a design: a larger one is refused while it is read.
inline constexpr size_t most_points = 100000;

/// Reads the design of an entry of `techniques`. Returns the changed values of each point; a single empty object if
/// there is no design. At most one of these keys is given:
///
/// - `sweep`: all combinations; axes by name, the last axis fastest.
/// - `zip`: values at the same place of each axis.
/// - `each`: one value at a time; axes in the order of `declared`.
/// - `random`, `latin_hypercube`, `sobol`: samples; equal points count once.
///
/// Every mistake is an Error that names place and key.
std::vector<nlohmann::json> read_design(ConfigObject& entry, const ParameterSet& declared);

/// The keys of a design, for a technique with these parameters.
Keys design_keys(const ParameterSet& declared);

/// The values [from, to], followed by `more` numbers.
Values range_values(int more);

/// Fails with Error unless `axis` is a valid axis of a sample: an array of values that the parameter may have, or
/// {"lin": [from, to]} or {"log": [from, to]} within its range. `at` begins the message.
void check_sample_axis(const nlohmann::json& axis, const ParameterSet& declared, const std::string& name,
                       const std::string& at);

/// The value in the declared parameter's type. Fails with Error if no parameter has this name, or if it may not have
/// the value; `where` begins the message.
nlohmann::json checked_value(const ParameterSet& declared, const std::string& name, const nlohmann::json& value,
                             const std::string& where);
