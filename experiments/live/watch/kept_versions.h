#pragma once
#include "experiments/live/watch/watch_study.h"

/// A kept version of a technique, with its measurements.
struct KeptVersion {
    std::string name;           ///< its folder in WatchSettings::out: versions/<name>
    std::string preset, at;     ///< at: when it was kept
    nlohmann::json parameters;  ///< values changed by the page's sliders
    nlohmann::json numbers;     ///< measurements in the page's form

    WatchedPoint point() const;
};

/// The kept versions in a watch's folder, oldest first: versions.json, and copies of the technique's folder.
class KeptVersions {
public:
    /// Loads versions of earlier watches in WatchSettings::out. Fails with Error if versions.json is broken, or is of
    /// another technique or of other scenes. Removes what a killed watch left of a version.
    explicit KeptVersions(const WatchSettings& settings);

    /// Copies the technique in technique/ as the next version, and its results in `now`, so that `ssrlab diff` can
    /// compare two versions.
    const KeptVersion& keep(const std::string& preset, const nlohmann::json& parameters, const nlohmann::json& numbers);

    const std::vector<KeptVersion>& all() const { return versions_; }

private:
    void load();
    /// The folder of a version or of the technique, in a part of the watch's folder.
    std::filesystem::path part(const char* of, const std::string& name) const;

    const std::filesystem::path out_;
    const std::string technique_;
    const nlohmann::json of_;  ///< {"technique", "scenes"}, for versions.json
    std::vector<KeptVersion> versions_;
};
