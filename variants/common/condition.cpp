#include "variants/common/condition.h"

#include "core/error.h"
#include "core/value_condition.h"

#include <algorithm>

using nlohmann::json;

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(SceneFacts, has_geometry, has_reflective, has_matte, min_roughness, max_roughness,
                                   camera_moves, objects_move, has_environment, has_textures, has_alpha_masks,
                                   has_normal_maps, has_vertex_colors, has_faulty_inputs)

namespace {

/// Of a shot of which nothing is known.
json facts_of_anything() {
    json facts = facts_by_name({});
    for (json& fact : facts)
        if (fact.is_boolean()) fact = true;
    facts["shot.is_still"] = false;
    facts["shot.min_roughness"] = json_number(0), facts["shot.max_roughness"] = json_number(1);
    return facts;
}

/// The conditions with values in place of the names of parameters.
json with_limits(json conditions, const json& values) {
    for (const auto& [name, condition] : conditions.items())
        if (condition.is_object() && values.contains(name) && values[name].is_number())
            for (json& limit : condition)
                if (limit.is_string() && values.contains(limit)) limit = values[limit.get<std::string>()];
    return conditions;
}

void check_members(const JsonObject& condition, const json& members, const KnownValues& known) {
    check_conditions(with_limits(members, known.by_name()), known.by_name(), condition);
}

}  // namespace

json facts_by_name(const SceneFacts& facts) {
    json named = {{"shot.is_still", facts.is_still()}};
    const json own = facts;
    for (const auto& [name, fact] : own.items())
        named["shot." + name] = fact.is_number() ? json_number(fact.get<float>()) : fact;
    return named;
}

KnownValues::KnownValues(const ParameterSet& params) : KnownValues(params, std::nullopt) {}

KnownValues::KnownValues(const ParameterSet& params, const std::optional<SceneFacts>& known)
    : values_(params.values()), knows_shot_(known.has_value()) {
    values_.update(known ? facts_by_name(*known) : facts_of_anything());
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
    return any_.empty() || std::ranges::any_of(any_, [&](const json& members) {
               return all_hold(with_limits(members, known.by_name()), known.by_name());
           });
}

std::string Condition::failing_member(const KnownValues& known) const {
    for (const json& members : any_) {
        const json limited = with_limits(members, known.by_name());
        for (const auto& [name, test] : limited.items())
            if (const json& value = known.by_name().at(name); !::holds(test, value))
                return name + " is " + shown(value);
    }
    return {};
}
