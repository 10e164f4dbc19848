#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

// finished.json of a results folder: the record of a finished run. The same run again finds it and reads no cell, image
// or reference.

/// `key`: all that the run depended on. `said`: its last messages. Files are known by size and time of change.
void keep_finished_run(const std::filesystem::path& results, const std::string& key,
                       const std::vector<std::string>& said);

/// The finished run's last messages; nullopt if it had another key, or if a file has changed since.
std::optional<std::vector<std::string>> find_finished_run(const std::filesystem::path& results, const std::string& key);
