#pragma once
#include "core/parameters.h"

struct Meaning {
    std::string unit, doc, source;
};

/// Of the type "float", "int" or "uint".
inline Parameter declared_number(const std::string& name, const std::string& type, const nlohmann::json& value,
                                 const nlohmann::json& min, const nlohmann::json& max, const Meaning& meaning = {},
                                 Use use = Use::uniform) {
    return {.name = name,
            .glsl_type = type,
            .unit = meaning.unit,
            .doc = meaning.doc,
            .source = meaning.source,
            .value = value,
            .initial = value,
            .min = min,
            .max = max,
            .use = use,
            .choices = {}};
}

/// Off, and compiled in.
inline Parameter declared_switch(const std::string& name) {
    return declared_number(name, "bool", false, false, true, {}, Use::constant);
}
