#pragma once
#include "core/parameters.h"
#include "experiments/study/config/keys.h"

#include <vector>

/// More points than anyone can run or look at: such a design is refused while it is read.
inline constexpr size_t most_points = 100000;

/// The points that an entry of `techniques` asks for by one of `sweep` (all combinations, the last axis fastest, axes
/// by name), `zip` (values that stand at the same place), `each` (one value at a time, axes in the order of
/// `declared`), `random`, `latin_hypercube` or `sobol`: the values that each of them changes; a single point without
/// any if there is no design. Points of the latter three that are equal count once. Every mistake is an Error that
/// names place and key.
std::vector<nlohmann::json> read_design(ConfigObject& entry, const ParameterSet& declared);

/// Its keys, for a technique with these parameters.
Keys design_keys(const ParameterSet& declared);

/// [from, to], with `more` numbers behind.
Values range_values(int more);

/// Fails unless `axis` is what an axis of a sample may be: an array of values that the parameter may have, or
/// {"lin": [from, to]} or {"log": [from, to]} of such; `at` begins the message.
void check_sample_axis(const nlohmann::json& axis, const ParameterSet& declared, const std::string& name,
                       const std::string& at);

/// The value as the declared parameter holds it. Fails unless there is one of that name, which may have the value;
/// `where` begins the message.
nlohmann::json checked_value(const ParameterSet& declared, const std::string& name, const nlohmann::json& value,
                             const std::string& where);
