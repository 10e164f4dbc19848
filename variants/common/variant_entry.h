#pragma once
#include "core/variant.h"

#include <functional>

/// Named values of some parameters of a variant.
struct Preset {
    std::string name, meaning;
    nlohmann::json parameters;
};

/// The API whose limits a technique obeys, so that it runs there. `lifted_by` holds values of parameters; each of them
/// asks for more than the API has and lifts the limits.
struct VariantLimits {
    Limits api = Limits::none;
    nlohmann::json lifted_by = nlohmann::json::object();
};

/// One row of the table of techniques.
struct VariantEntry {
    std::string name, title, source, description;
    std::vector<Preset> presets;
    VariantLimits limits{};
    std::function<std::unique_ptr<Variant>()> create;
};

/// Parameter values with others changed or added: for presets that begin with another.
inline nlohmann::json changed(nlohmann::json parameters, const nlohmann::json& more) {
    parameters.update(more);
    return parameters;
}
