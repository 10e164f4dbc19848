#pragma once
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

/// An error as the page shows it: {"text", "places": [{"file", "line", "lines": [{"number", "text"}]}]}. Each place
/// that `text` names as FILE:LINE and that can be read has its line and those around it, once. FILE is looked up in
/// `copy`, the copied folder of a technique, and among ssrlab's shaders; where `text` names the copy, it says `folder`
/// instead, where its author looks.
nlohmann::json error_with_places(std::string text, const std::filesystem::path& copy,
                                 const std::filesystem::path& folder);
