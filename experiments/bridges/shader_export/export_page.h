#pragma once
#include <nlohmann/json.hpp>
#include <string>

/// passes.json of ShaderExport as a page in Markdown for a reader who ports the technique.
std::string export_page(const nlohmann::json& description);
