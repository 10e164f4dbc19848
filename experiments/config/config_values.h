#pragma once
#include "core/json.h"

#include <optional>
#include <string>
#include <vector>

// Values that several parts of a config have alike. Every mistake is an Error that names place and key.

/// A text, or an array of texts that is not empty; `fallback` if the key is absent.
std::vector<std::string> one_or_more(JsonObject& object, const std::string& key, const std::string& fallback);

/// one_or_more() of `known` names.
std::vector<std::string> known_names(JsonObject& object, const std::string& key, const std::vector<std::string>& known,
                                     const std::vector<std::string>& fallback, bool may_be_empty = false);

/// A count n, which stands for 0 .. n-1, or an array of ascending whole numbers up to `max`. `where` begins messages.
std::vector<unsigned> read_numbers(const nlohmann::json& value, const std::string& where, unsigned max);

/// The seeds that a study or a variant names; none if it names none.
std::optional<std::vector<unsigned>> read_seeds(JsonObject& object);

/// `text` with what stands in braces replaced by the member of `values` that is named so: "{dda.stride} px" is "4 px",
/// numbers with four digits. Fails on names that `values` does not have; `where` begins the message.
std::string fill_in(const std::string& text, const nlohmann::json& values, const std::string& where);

/// A value as names and labels have it: a text without its quotes.
std::string plain_text(const nlohmann::json& value);
