#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

/// `pattern` with `number` in place of its last run of #, with leading zeros to the length of the run: "f_##.exr" and 7
/// make "f_07.exr". Nullopt if there is no # at or behind `from`.
std::optional<std::string> numbered_name(const std::string& pattern, unsigned number, size_t from = 0);

/// True if the path's last part has a #, and no file has that very name.
bool is_numbered_pattern(const std::filesystem::path& pattern);

/// The files that a pattern in the last part of a path stands for, by ascending number. Numbers have up to nine digits.
/// Fails with Error if there is none, or if one is missing between the first and the last.
std::vector<std::filesystem::path> numbered_files(const std::filesystem::path& pattern);
