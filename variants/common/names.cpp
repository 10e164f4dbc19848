#include "variants/common/names.h"

#include "core/error.h"
#include "core/near_miss.h"

#include <cctype>

void know_keys(JsonObject& object, std::initializer_list<const char*> keys) {
    for (const char* key : keys) object.has(key);
}

std::string variable_name(JsonObject& object, const std::string& key) {
    std::string name = object.text(key);
    const auto fits = [](unsigned char c) { return std::isalnum(c) || c == '_'; };
    if (name.empty() || !std::ranges::all_of(name, fits) || std::isdigit(static_cast<unsigned char>(name[0])) ||
        name.starts_with("gl_") || name.find("__") != std::string::npos || name.size() > 60)
        fail(object.at(key), ": '", key, "' = '", shortened(name),
             "' cannot be a name in GLSL: letters, digits and '_', a letter first, no '__' and no 'gl_'");
    return name;
}

std::string variable_name(JsonObject& object, const std::string& key, const std::string& fallback) {
    return object.has(key) ? variable_name(object, key) : fallback;
}
