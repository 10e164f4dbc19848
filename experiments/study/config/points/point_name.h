#pragma once
#include <nlohmann/json.hpp>
#include <string>

/// Parameter values as points are named by them: {"estimator": "a", "taps": 4} is `estimator=a taps=4`.
std::string label_of(const nlohmann::json& values);

/// A point's name in results: the preset and the values that a design gave it, or "default". A name of more than 80
/// characters keeps only the words that fit into 58 and ends in # and a hash of all: parameters.csv has every value.
std::string point_name(const std::string& preset, const nlohmann::json& swept);

/// `text` with what stands in braces replaced by the member of `values` that is named so: "{dda.stride} px" is "4 px",
/// numbers with four digits. Fails on names that `values` does not have; `where` begins the message.
std::string fill_in(const std::string& text, const nlohmann::json& values, const std::string& where);

/// A value as names and labels have it: a text without its quotes.
std::string plain_text(const nlohmann::json& value);
