#pragma once
#include <span>
#include <string>
#include <string_view>

/// The member of `choices` nearest to `name` by Damerau-Levenshtein distance (optimal string alignment), or "" if none is
/// within a third of its length.
std::string nearest_name(std::string_view name, std::span<const std::string> choices);

/// "; did you mean 'thickness'?" where a near miss exists, else "; known are: a, b, c".
std::string suggestion(std::string_view name, std::span<const std::string> choices);
