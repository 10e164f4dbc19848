#pragma once
#include <chrono>
#include <filesystem>
#include <map>
#include <optional>
#include <string>

/// When a file was last written; nullopt if it does not exist.
std::optional<std::chrono::system_clock::time_point> written_at(const std::filesystem::path& file);

/// EXR files that a running study has written of a technique since `since`, and those of the truth, by label ("now",
/// "truth") and target ("image", "specular"). A study writes the images of its first seed before it measures anything.
/// Fails with Error if the folder of images is a link.
std::map<std::string, std::map<std::string, std::filesystem::path>> fresh_images(
    const std::filesystem::path& results, const std::string& technique, std::chrono::system_clock::time_point since);
