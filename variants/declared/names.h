#pragma once
#include "core/json.h"

/// A member that shaders have as a name: letters, digits and '_', no digit first, nothing that GLSL keeps for itself.
/// Fails with Error otherwise.
std::string variable_name(JsonObject& object, const std::string& key);
std::string variable_name(JsonObject& object, const std::string& key, const std::string& fallback);
