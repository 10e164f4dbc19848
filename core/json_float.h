#pragma once
#include <nlohmann/json.hpp>
#include <string>

/// The JSON number as float32. Fails with Error, which begins with `what`, if float32 cannot hold it.
float float_of(const nlohmann::json& number, const std::string& what);
