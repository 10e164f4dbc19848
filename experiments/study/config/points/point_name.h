#pragma once
#include <nlohmann/json.hpp>
#include <string>

/// Parameter values as they stand in names of points: {"estimator": "a", "taps": 4} gives `estimator=a taps=4`.
std::string label_of(const nlohmann::json& values);

/// A point's name in results: the preset and the values that a design set, or "default". A name of more than 80
/// characters is cut to the words that fit into 58, followed by # and a hash of all; parameters.csv has every value.
std::string point_name(const std::string& preset, const nlohmann::json& swept);

/// `text` with each name in braces replaced by that member of `values`: "{dda.stride} px" gives "4 px". Numbers have
/// four digits. Fails with Error on names that `values` lacks; `where` begins the message.
std::string fill_in(const std::string& text, const nlohmann::json& values, const std::string& where);

/// A value as it stands in names and labels: texts without quotes.
std::string plain_text(const nlohmann::json& value);
