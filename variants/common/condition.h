#pragma once
#include "core/gbuffer/scene_facts.h"
#include "core/json.h"
#include "core/parameters.h"

#include <optional>

struct NamedCondition;

/// The facts as conditions name them, `shot.max_roughness`.
nlohmann::json facts_by_name(const SceneFacts& facts);

/// The values that conditions can use: parameters, facts of the rendered shot (facts_by_name()), whether the device
/// takes GPU forms of shaders (`device.is_gpu`), and named conditions.
class KnownValues {
public:
    /// The shot is unknown: it may show anything.
    explicit KnownValues(const ParameterSet& params);
    KnownValues(const ParameterSet& params, const std::optional<SceneFacts>& facts);

    const nlohmann::json& by_name() const { return values_; }
    void set(const std::string& name, nlohmann::json value) { values_[name] = std::move(value); }
    /// Sets each named condition from the known values.
    void derive(const std::vector<NamedCondition>& conditions);

    bool knows_shot() const { return knows_shot_; }
    void know_shot() { knows_shot_ = true; }

private:
    nlohmann::json values_;
    bool knows_shot_ = false;
};

/// A condition of a technique.json, {"mode": ["stochastic", "temporal"], "blur_width": {"above": 0}}: holds if all its
/// members hold (core/value_condition.h). An array of conditions holds if one of them does. A limit may be the name of
/// a numeric parameter: {"shot.min_roughness": {"at_least": "rough_from"}}.
class Condition {
public:
    Condition() = default;  ///< always holds
    /// The condition under `key` of `object`; always holds without the key. Fails if it names an unknown value, or
    /// compares a value with something that it cannot be.
    Condition(JsonObject& object, const std::string& key, const KnownValues& known);
    static Condition never();
    /// The same for a member that may also be true or false; false without the key.
    static Condition or_truth(JsonObject& object, const std::string& key, const KnownValues& known);

    bool holds(const KnownValues& known) const;
    bool is_always() const { return any_.empty() && !is_never_; }
    /// The objects of members, one of which must hold.
    const nlohmann::json& alternatives() const { return any_; }
    /// "shot.max_roughness is 0": the first member that does not hold, and the value.
    std::string failing_member(const KnownValues& known) const;

private:
    nlohmann::json any_ = nlohmann::json::array();
    bool is_never_ = false;
};

/// An entry of `conditions`: other conditions use its name like a parameter that is true or false.
struct NamedCondition {
    std::string name;
    Condition condition;
};
