#pragma once
#include "experiments/live/watch/watch_settings.h"
#include "experiments/results/verdicts/effects/over_scenes.h"

/// A point in the studies of a watch.
struct WatchedPoint {
    std::string technique;  ///< name in configs in WatchSettings::out
    std::string preset, label;
    nlohmann::json parameters = nlohmann::json::object();
    bool is_baseline = true;  ///< whether other points are compared with it

    PointName name() const;  ///< name in results
};

/// The point that WatchSettings::against names; "best": the point of least error in the included studies. Fails with
/// Error if there is none.
WatchedPoint point_against(const std::string& asked);

/// Parts of a watch's folder, relative to WatchSettings::out: technique/NAME, the copy that is rendered;
/// versions/NAME_1, ..., the kept copies; numbers/NAME_1, ..., what was measured of them; each study's config, and its
/// results folder beside it; watch.lock.
namespace watch_folder {
inline constexpr const char *technique = "technique", *versions = "versions", *kept_numbers = "numbers";
/// Results folders: `now` of what is shown; `coarse` of what is shown until the truth has all samples; `why` of where
/// rays end; `times` of times and costs; `kept` of all kept versions.
inline constexpr const char *now = "now", *coarse = "coarse", *why = "why", *times = "times", *kept = "kept",
                            *truth = "truth";
}  // namespace watch_folder

/// Samples of the truth, and of its guide, until the full samples exist.
inline constexpr unsigned coarse_samples = 16;

/// A study, for `ssrlab run`, of the points and of no reflections in the first `scenes` scenes. `samples`: of the
/// truth. With `is_whole` it measures the errors that studies report, else a single error.
nlohmann::json numbers_study(const WatchSettings& settings, const std::vector<WatchedPoint>& points, size_t scenes,
                             unsigned samples, bool is_whole);

/// A study of where a point's rays end in the first scene: why the point errs.
nlohmann::json why_study(const WatchSettings& settings, const WatchedPoint& point);

/// A study of the times of the points' stages, here and on a GPU.
nlohmann::json times_study(const WatchSettings& settings, const std::vector<WatchedPoint>& points);
