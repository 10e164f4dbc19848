#pragma once
#include "core/gbuffer/scene_facts.h"
#include "core/json.h"
#include "core/parameters.h"

#include <optional>

struct NamedCondition;

/// The facts as conditions name them, `shot.max_roughness`.
nlohmann::json facts_by_name(const SceneFacts& facts);

/// What conditions can ask for: values of parameters, facts of the shot that is rendered (facts_by_name()),
/// whether the device takes the forms of shaders for GPUs (`device.is_gpu`), and conditions with a name.
class KnownValues {
public:
    /// Nothing is known of the shot: it may show anything.
    explicit KnownValues(const ParameterSet& params);
    KnownValues(const ParameterSet& params, const std::optional<SceneFacts>& facts);

    const nlohmann::json& by_name() const { return values_; }
    void set(const std::string& name, nlohmann::json value) { values_[name] = std::move(value); }
    /// Sets each named condition by the values that there are.
    void derive(const std::vector<NamedCondition>& conditions);

    bool knows_shot() const { return knows_shot_; }
    void know_shot() { knows_shot_ = true; }

private:
    nlohmann::json values_;
    bool knows_shot_ = false;
};

/// A condition of a technique.json, {"mode": ["stochastic", "temporal"], "blur_width": {"above": 0}}: all of its
/// members hold (core/value_condition.h). Of an array of them any holds. A limit may be the name of a parameter of
/// numbers: {"shot.min_roughness": {"at_least": "rough_from"}}.
class Condition {
public:
    Condition() = default;  ///< that always holds
    /// A member of `object`; without one it always holds. Fails where it names no known value, or compares it with what
    /// it cannot be.
    Condition(JsonObject& object, const std::string& key, const KnownValues& known);
    static Condition never();
    /// The same of a member that may also be true or false, and is false where it is not there.
    static Condition or_truth(JsonObject& object, const std::string& key, const KnownValues& known);

    bool holds(const KnownValues& known) const;
    bool is_always() const { return any_.empty() && !is_never_; }
    /// Objects of members, of which one must hold.
    const nlohmann::json& alternatives() const { return any_; }
    /// "shot.max_roughness is 0": the first member that does not hold, and the value.
    std::string failing_member(const KnownValues& known) const;

private:
    nlohmann::json any_ = nlohmann::json::array();
    bool is_never_ = false;
};

/// Of `conditions`: what others call by its name, as if it were a parameter that is true or false.
struct NamedCondition {
    std::string name;
    Condition condition;
};
