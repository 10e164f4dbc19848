#include "variants/declared/condition.h"

#include "core/error.h"
#include "core/near_miss.h"
#include "core/value_condition.h"

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

}  // namespace

KnownValues::KnownValues(const ParameterSet& params) : KnownValues(params, anything) {}

KnownValues::KnownValues(const ParameterSet& params, const SceneFacts& facts) : values_(params.values()) {
    values_["shot.has_reflective"] = facts.has_reflective;
    values_["shot.has_matte"] = facts.has_matte;
    values_["shot.min_roughness"] = json_number(facts.min_roughness);
    values_["shot.max_roughness"] = json_number(facts.max_roughness);
    values_["shot.is_still"] = facts.is_still();
    values_["shot.has_environment"] = facts.has_environment;
}

Condition::Condition(JsonObject& object, const std::string& key, const KnownValues& known) {
    if (!object.has(key)) return;
    const JsonObject condition = object.object(key);
    members_ = object.any(key);
    for (const auto& [name, test] : members_.items()) {
        if (!known.by_name().contains(name)) {
            std::vector<std::string> names;
            for (const auto& [value_name, value] : known.by_name().items()) names.push_back(value_name);
            fail(condition.at(name), ": '", shortened(name), "' is no parameter and no fact of a shot",
                 suggestion(name, names));
        }
        check_condition(test, known.by_name()[name], condition.at(name) + ": '" + name + "'");
    }
}

Condition Condition::never() {
    Condition condition;
    condition.is_never_ = true;
    return condition;
}

bool Condition::holds(const KnownValues& known) const {
    if (is_never_) return false;
    for (const auto& [name, test] : members_.items())
        if (!::holds(test, known.by_name().at(name))) return false;
    return true;
}

std::string Condition::failing_member(const KnownValues& known) const {
    for (const auto& [name, test] : members_.items())
        if (const json& value = known.by_name().at(name); !::holds(test, value)) return name + " is " + shown(value);
    return {};
}
