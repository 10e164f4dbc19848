#pragma once
#include "experiments/study/config/config.h"

#include <filesystem>
#include <functional>
#include <string>

/// Makes the results folder that of one study, named in study.json: {"config", "keep_all"}. Two studies are the same if
/// their configs, without comments and `$schema`, and --keep-all are. Any number of processes may fill
/// the folder of one study.
///
/// Fails with Error, before anything is written, if the folder holds another study, unless `replaces`: then the folder
/// is this study's from now on. A folder of a version without study.json belongs to the config in its manifest.json.
/// `notice` gets a sentence where a study was replaced.
class FolderOwner {
public:
    FolderOwner(const std::filesystem::path& folder, const Config& config, bool keep_all, bool replaces,
                const std::function<void(const std::string&)>& notice);
    /// A study that failed before its first cell leaves the folder free for a corrected config.
    ~FolderOwner();
    FolderOwner(const FolderOwner&) = delete;
    FolderOwner& operator=(const FolderOwner&) = delete;

private:
    std::filesystem::path folder_;
    bool has_created_ = false;
};

/// Fails with Error unless the folder holds results of this study.
void check_owner(const std::filesystem::path& folder, const Config& config, bool keep_all);
