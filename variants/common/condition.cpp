#include "variants/common/condition.h"

#include "core/error.h"
#include "core/near_miss.h"
#include "core/value_condition.h"

#include <algorithm>

using nlohmann::json;

namespace {

const SceneFacts anything = {.has_geometry = true,
                             .has_reflective = true,
                             .has_matte = true,
                             .min_roughness = 0,
                             .max_roughness = 1,
                             .camera_moves = true,
                             .objects_move = true,
                             .has_environment = true};

/// The test with values in place of the names of parameters.
json with_limits(const json& test, const KnownValues& known) {
    if (!test.is_object()) return test;
    json with = test;
    for (json& limit : with)
        if (limit.is_string() && known.by_name().contains(limit)) limit = known.by_name()[limit.get<std::string>()];
    return with;
}

bool member_holds(const json& test, const json& value, const KnownValues& known) {
    return holds(value.is_number() ? with_limits(test, known) : test, value);
}

bool all_hold(const json& members, const KnownValues& known) {
    return std::ranges::all_of(members.items(), [&](const auto& member) {
        return member_holds(member.value(), known.by_name().at(member.key()), known);
    });
}

void check_members(const JsonObject& condition, const json& members, const KnownValues& known) {
    for (const auto& [name, test] : members.items()) {
        if (!known.by_name().contains(name)) {
            std::vector<std::string> names;
            for (const auto& [value_name, value] : known.by_name().items()) names.push_back(value_name);
            fail(condition.at(name), ": '", shortened(name), "' is no parameter and no fact of a shot",
                 suggestion(name, names));
        }
        const json& value = known.by_name()[name];
        check_condition(value.is_number() ? with_limits(test, known) : test, value,
                        condition.at(name) + ": '" + name + "'");
    }
}

}  // namespace

KnownValues::KnownValues(const ParameterSet& params) : KnownValues(params, std::nullopt) {}

KnownValues::KnownValues(const ParameterSet& params, const std::optional<SceneFacts>& known)
    : values_(params.values()), knows_shot_(known.has_value()) {
    const SceneFacts& facts = known ? *known : anything;
    values_["shot.has_reflective"] = facts.has_reflective;
    values_["shot.has_matte"] = facts.has_matte;
    values_["shot.min_roughness"] = json_number(facts.min_roughness);
    values_["shot.max_roughness"] = json_number(facts.max_roughness);
    values_["shot.is_still"] = facts.is_still();
    values_["shot.has_environment"] = facts.has_environment;
    values_["device.is_gpu"] = false;
}

void KnownValues::derive(const std::vector<NamedCondition>& conditions) {
    for (const auto& [name, condition] : conditions) values_[name] = condition.holds(*this);
}

Condition::Condition(JsonObject& object, const std::string& key, const KnownValues& known) {
    if (!object.has(key)) return;
    const json& written = object.any(key);
    if (!written.is_array()) {
        any_ = json::array({written});
        check_members(object.object(key), written, known);
        return;
    }
    any_ = written;
    if (any_.empty()) fail(object.at(key), ": '", key, "' is empty: none of its conditions can hold");
    const std::vector<JsonObject> alternatives = object.objects(key);
    for (size_t i = 0; i < alternatives.size(); ++i) check_members(alternatives[i], written[i], known);
}

Condition Condition::never() {
    Condition condition;
    condition.is_never_ = true;
    return condition;
}

Condition Condition::or_truth(JsonObject& object, const std::string& key, const KnownValues& known) {
    if (!object.has(key) || object.any(key) == false) return never();
    return object.any(key) == true ? Condition() : Condition(object, key, known);
}

bool Condition::holds(const KnownValues& known) const {
    if (is_never_) return false;
    return any_.empty() || std::ranges::any_of(any_, [&](const json& members) { return all_hold(members, known); });
}

std::string Condition::failing_member(const KnownValues& known) const {
    for (const json& members : any_)
        for (const auto& [name, test] : members.items())
            if (const json& value = known.by_name().at(name); !member_holds(test, value, known))
                return name + " is " + shown(value);
    return {};
}
