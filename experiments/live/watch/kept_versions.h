#pragma once
#include "experiments/live/watch/watch_study.h"

/// A version of a technique that was kept, with what it measured.
struct KeptVersion {
    std::string name;           ///< of its folder in WatchSettings::out: versions/<name>
    std::string preset, at;     ///< when it was kept
    nlohmann::json parameters;  ///< that the page's sliders had changed
    nlohmann::json numbers;     ///< as the page shows them

    WatchedPoint point() const;
};

/// The kept versions of a watch's folder, the oldest first: versions.json, and copies of the technique's folder.
class KeptVersions {
public:
    /// Of the watch before, too, if the folder had one. Fails with Error where versions.json is broken.
    KeptVersions(std::filesystem::path out, std::string technique);

    /// Copies the technique in technique/ as the next version, and its results in `now`, so that `ssrlab diff` can
    /// compare two versions of one name.
    const KeptVersion& keep(const std::string& preset, const nlohmann::json& parameters, const nlohmann::json& numbers);

    const std::vector<KeptVersion>& all() const { return versions_; }

private:
    const std::filesystem::path out_;
    const std::string technique_;
    std::vector<KeptVersion> versions_;
};
