#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

// finished.json of a results folder: what a run left that had nothing more to do, so that the same run again reads no
// cell, no image and no reference to find that out.

/// `key`: all that the run depended on. `said`: what it told its user last. Files are known by size and time of change.
void keep_finished_run(const std::filesystem::path& results, const std::string& key,
                       const std::vector<std::string>& said);

/// What was said; nothing if the run that finished last had another key, or if a file that it left has changed since.
std::optional<std::vector<std::string>> find_finished_run(const std::filesystem::path& results, const std::string& key);
