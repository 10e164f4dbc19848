#pragma once
#include "experiments/study/config/config.h"

#include <filesystem>
#include <functional>
#include <string>

/// Ties a results folder to one study by study.json: {"config", "keep_all"}. Two studies are the same if --keep-all and
/// their configs, without comments and `$schema`, are equal. Any number of processes may fill the folder of one study.
///
/// Fails with Error, before anything is written, if the folder holds another study. With `replaces` the folder changes
/// to this study instead, and `notice` gets a sentence. A folder without study.json belongs to the config in its
/// manifest.json.
class FolderOwner {
public:
    FolderOwner(const std::filesystem::path& folder, const Config& config, bool keep_all, bool replaces,
                const std::function<void(const std::string&)>& notice);
    /// Removes study.json if the study failed before its first cell, so that a corrected config can use the folder.
    ~FolderOwner();
    FolderOwner(const FolderOwner&) = delete;
    FolderOwner& operator=(const FolderOwner&) = delete;

private:
    std::filesystem::path folder_;
    bool has_created_ = false;
};

/// Fails with Error unless the folder holds results of this study.
void check_owner(const std::filesystem::path& folder, const Config& config, bool keep_all);
