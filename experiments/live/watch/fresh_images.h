#pragma once
#include <chrono>
#include <filesystem>
#include <map>
#include <optional>
#include <string>

/// When a file was written; none if it is gone.
std::optional<std::chrono::system_clock::time_point> written_at(const std::filesystem::path& file);

/// The EXR files of images that a running study has written of a technique since `since`, and those of the truth, by
/// label ("now", "truth") and target ("image", "specular"). A study writes those of its first seed before it has
/// measured anything.
std::map<std::string, std::map<std::string, std::filesystem::path>> fresh_images(
    const std::filesystem::path& results, const std::string& technique, std::chrono::system_clock::time_point since);
