#pragma once
#include <nlohmann/json.hpp>
#include <string>

/// JSON Schema (2020-12) of a study's config; with the name of a technique, of that technique's `parameters` alone.
nlohmann::json config_schema(const std::string& technique);

/// The text with the tables of a config's keys between its lines `<!-- keys of study -->` (scene, capture, shot,
/// technique, table, tune) and `<!-- end of keys -->`. Fails where one of them is missing.
std::string with_key_tables(const std::string& markdown);
