#include "experiments/config/config_values.h"

#include "core/error.h"
#include "core/near_miss.h"

#include <algorithm>
#include <cstdio>
#include <functional>

std::vector<std::string> one_or_more(JsonObject& object, const std::string& key, const std::string& fallback) {
    if (!object.has(key)) return {fallback};
    const nlohmann::json& value = object.any(key);
    if (value.is_string()) return {value.get<std::string>()};
    const bool fits =
        value.is_array() && !value.empty() && std::ranges::all_of(value, [](const auto& v) { return v.is_string(); });
    if (!fits) fail(object.at(key), ": '", key, "' must be a text or an array of texts, not ", shown(value));
    return value.get<std::vector<std::string>>();
}

std::vector<std::string> known_names(JsonObject& object, const std::string& key, const std::vector<std::string>& known,
                                     const std::vector<std::string>& fallback, bool may_be_empty) {
    if (!object.has(key)) return fallback;
    if (may_be_empty && object.any(key) == nlohmann::json::array()) return {};
    const std::vector<std::string> names = one_or_more(object, key, "");
    for (const std::string& name : names)
        if (std::ranges::find(known, name) == known.end())
            fail(object.at(key), ": '", key, "' names \"", name, "\", which is not known", suggestion(name, known));
    return names;
}

std::vector<unsigned> read_numbers(const nlohmann::json& value, const std::string& where, unsigned max) {
    std::vector<unsigned> list;
    if (!value.is_array()) {
        if (!value.is_number_integer() || value < 1 || value > max)
            fail(where, " must be a count in [1, ", max, "] or an array of whole numbers, not ", shown(value));
        for (unsigned i = 0; i < value.get<unsigned>(); ++i) list.push_back(i);
        return list;
    }
    for (const auto& v : value) {
        if (!v.is_number_integer() || v < 0 || v > max)
            fail(where, " holds ", shown(v), "; allowed are whole numbers in [0, ", max, "]");
        list.push_back(v.get<unsigned>());
    }
    const bool ascends = std::ranges::adjacent_find(list, std::greater_equal()) == list.end();
    if (list.empty() || !ascends) fail(where, " must hold at least one number, each greater than the one before");
    return list;
}

std::optional<std::vector<unsigned>> read_seeds(JsonObject& object) {
    constexpr unsigned max_seed = 100000;
    if (!object.has("seeds")) return {};
    return read_numbers(object.any("seeds"), object.at("seeds") + ": 'seeds'", max_seed);
}

std::string fill_in(const std::string& text, const nlohmann::json& values, const std::string& where) {
    std::string filled;
    for (size_t at = 0; at < text.size();) {
        const size_t open = text.find('{', at), close = text.find('}', open);
        if (open == std::string::npos || close == std::string::npos) {
            filled += text.substr(at);
            break;
        }
        const std::string name = text.substr(open + 1, close - open - 1);
        if (!values.contains(name)) {
            std::vector<std::string> known;
            for (const auto& [key, value] : values.items()) known.push_back(key);
            fail(where, " names {", shortened(name), "}, which is not known", suggestion(name, known));
        }
        const nlohmann::json& value = values[name];
        char digits[32];  // a sampled number has eight, which nobody reads
        std::snprintf(digits, sizeof digits, "%.4g", value.is_number_float() ? value.get<double>() : 0.0);
        filled += text.substr(at, open - at) + (value.is_number_float() ? digits : plain_text(value));
        at = close + 1;
    }
    while (filled.ends_with(' ')) filled.pop_back();  // where the last value is empty
    return filled;
}

std::string plain_text(const nlohmann::json& value) {
    return value.is_string() ? value.get<std::string>() : value.dump();
}
