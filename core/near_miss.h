#pragma once
#include <span>
#include <string>
#include <string_view>

/// The text as messages show it: the middle of a long one is left out, and so are the data of data URIs.
std::string shortened(const std::string& text);

/// The member of `choices` nearest to `name` by Damerau-Levenshtein distance (optimal string alignment), if none is
/// within a third of its length the first that contains it ("thickness" of "relative_thickness"), or "". What is longer
/// than 100 characters is no name that somebody misspelt, and is near none.
std::string nearest_name(std::string_view name, std::span<const std::string> choices);

/// "; did you mean 'thickness'?" where a near miss exists, else "; known are: a, b, c".
std::string suggestion(std::string_view name, std::span<const std::string> choices);
