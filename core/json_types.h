#pragma once
#include <nlohmann/json.hpp>
#include <string>

enum class OtherMembers { refused, allowed };

/// Fails with Error, which names the place and the value, unless a JSON value from a file has `type`:
/// - "text", "number", "true or false", "count" (whole, from 0, 32 bits) or "size" (whole, from 0, 64 bits)
/// - "object": any members
/// - [type]: an array of such values
/// - {key: type}: an object of these members; one whose key ends in "?" may be missing, in "??" also null
/// - {"*": type}: an object of any keys
/// `where`: the value's name in messages. `others`: whether objects may have further members.
void require_type(const nlohmann::json& value, const nlohmann::json& type, const std::string& where,
                  OtherMembers others = OtherMembers::refused);
