#pragma once
#include "core/json.h"

#include <initializer_list>

/// Makes the keys of an object known before it is read, so that a message about a missing key does not take other keys
/// for its misspelling.
void know_keys(JsonObject& object, std::initializer_list<const char*> keys);

/// A member that is a name in shaders: letters, digits and '_', no digit first, nothing that GLSL keeps for itself.
/// Fails with Error otherwise.
std::string variable_name(JsonObject& object, const std::string& key);
std::string variable_name(JsonObject& object, const std::string& key, const std::string& fallback);
