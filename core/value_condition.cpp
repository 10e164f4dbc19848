#include "core/value_condition.h"

#include "core/error.h"
#include "core/json_float.h"
#include "core/near_miss.h"

#include <algorithm>

using nlohmann::json;

namespace {

bool is_equal(const json& a, const json& b) {
    if (a.is_number() && b.is_number()) return a.get<float>() == b.get<float>();
    return a == b;
}

}  // namespace

bool holds(const json& condition, const json& value) {
    if (condition.is_array())
        return std::ranges::any_of(condition, [&](const json& one) { return is_equal(one, value); });
    if (!condition.is_object()) return is_equal(condition, value);
    return std::ranges::all_of(condition.items(), [&](const auto& part) {
        const std::string& how = part.key();
        if (how == "not") return !holds(part.value(), value);
        const float number = value.get<float>(), limit = part.value().template get<float>();
        return how == "at_least"  ? number >= limit
               : how == "at_most" ? number <= limit
               : how == "above"   ? number > limit
                                  : number < limit;
    });
}

void check_condition(const json& condition, const json& sample, const std::string& where) {
    const auto check_value = [&](const json& value) {
        if (value.type() != sample.type() && !(value.is_number() && sample.is_number()))
            fail(where, " is compared with ", shown(value), ", but its values are like ", shown(sample));
        if (value.is_number()) float_of(value, where);  // as which it is compared
    };
    if (condition.is_array()) {
        if (condition.empty()) fail(where, " is compared with no value");
        for (const json& value : condition) check_value(value);
    } else if (condition.is_object()) {
        const std::vector<std::string> known = {"at_least", "at_most", "above", "below", "not"};
        if (condition.empty()) fail(where, " has no condition", suggestion("", known));
        for (const auto& [how, limit] : condition.items()) {
            if (std::ranges::find(known, how) == known.end())
                fail(where, ": unknown key '", shortened(how), "'", suggestion(how, known));
            if (how == "not" && !limit.is_object()) {
                check_condition(limit, sample, where);
            } else {
                if (how == "not" || !limit.is_number() || !sample.is_number())
                    fail(where, ": '", how, "' = ", shown(limit), " does not fit; its values are like ", shown(sample));
                float_of(limit, where + ": '" + how + "'");
            }
        }
    } else {
        check_value(condition);
    }
}

void check_conditions(const json& conditions, const json& samples, const JsonObject& places) {
    for (const auto& [name, condition] : conditions.items()) {
        if (!samples.contains(name)) {
            std::vector<std::string> known;
            for (const auto& [value_name, value] : samples.items()) known.push_back(value_name);
            fail(places.at(name), ": '", shortened(name), "' is no parameter and no fact of a shot",
                 suggestion(name, known));
        }
        check_condition(condition, samples[name], places.at(name) + ": '" + name + "'");
    }
}

bool all_hold(const json& conditions, const json& values) {
    return std::ranges::all_of(conditions.items(),
                               [&](const auto& member) { return holds(member.value(), values.at(member.key())); });
}
