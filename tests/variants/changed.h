#pragma once
#include <nlohmann/json.hpp>

/// Parameter values with others changed or added.
inline nlohmann::json changed(nlohmann::json parameters, const nlohmann::json& more) {
    parameters.update(more);
    return parameters;
}
