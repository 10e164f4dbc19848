#pragma once
#include <nlohmann/json.hpp>
#include <string>

/// JSON Schema (2020-12) of a study's config; with the name of a variant, of that variant's `parameters` alone.
nlohmann::json config_schema(const std::string& variant);
