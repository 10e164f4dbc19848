#pragma once
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

/// An error in the page's form: {"text", "places": [{"file", "line", "lines": [{"number", "text"}]}]}. Each readable
/// place that `text` names as FILE:LINE appears once, with the lines around it. FILE is looked up in `copy`, the copied
/// folder of the technique, and among ssrlab's shaders. Where `text` names `copy`, the result names `folder`, which its
/// author knows.
nlohmann::json error_with_places(std::string text, const std::filesystem::path& copy,
                                 const std::filesystem::path& folder);
