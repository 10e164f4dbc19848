#pragma once
#include <nlohmann/json.hpp>
#include <string>

enum class OtherMembers { refused, allowed };

/// Fails with Error, which names the place and what stands there, unless a JSON value from a file has a type. `type`:
/// "text", "number", "true or false", or whole from 0, "count" (of 32 bits) and "size" (of 64); "object" of any
/// members; [type]: an array of such; {key: type}: an object of these members, of which one whose key ends in "?" may
/// be missing, in "??" also null, and of others where they are allowed; {"*": type}: of any keys. `where`: what
/// messages call the value.
void require_type(const nlohmann::json& value, const nlohmann::json& type, const std::string& where,
                  OtherMembers others = OtherMembers::refused);
