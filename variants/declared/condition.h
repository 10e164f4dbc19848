#pragma once
#include "core/gbuffer/scene_facts.h"
#include "core/json.h"
#include "core/parameters.h"

/// What conditions can ask for: values of a technique's parameters, and facts of the shot that it renders, as
/// `shot.max_roughness`.
class KnownValues {
public:
    /// Nothing is known of the shot: it may show anything.
    explicit KnownValues(const ParameterSet& params);
    KnownValues(const ParameterSet& params, const SceneFacts& facts);

    const nlohmann::json& by_name() const { return values_; }
    void set(const std::string& name, nlohmann::json value) { values_[name] = std::move(value); }

private:
    nlohmann::json values_;
};

/// A condition of a technique.json, {"mode": ["stochastic", "temporal"], "blur_width": {"above": 0}}: all of its
/// members hold (core/value_condition.h).
class Condition {
public:
    Condition() = default;  ///< that always holds
    /// A member of `object`; without one it always holds. Fails where it names no known value, or compares it with what
    /// it cannot be.
    Condition(JsonObject& object, const std::string& key, const KnownValues& known);
    static Condition never();

    bool holds(const KnownValues& known) const;
    bool is_always() const { return members_.empty() && !is_never_; }
    const nlohmann::json& members() const { return members_; }
    /// "shot.max_roughness is 0": the first member that does not hold, and the value.
    std::string failing_member(const KnownValues& known) const;

private:
    nlohmann::json members_ = nlohmann::json::object();
    bool is_never_ = false;
};
