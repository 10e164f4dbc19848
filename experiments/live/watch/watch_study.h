#pragma once
#include "experiments/live/watch/watch_settings.h"
#include "experiments/results/verdicts/effects/over_scenes.h"

/// A technique as a study that is written for a watch has it.
struct WatchedPoint {
    std::string technique;  ///< as configs in WatchSettings::out name it
    std::string preset, label;
    nlohmann::json parameters = nlohmann::json::object();
    bool is_baseline = true;  ///< that the others are compared with

    PointName name() const;  ///< in results
};

/// The technique that WatchSettings::against names; "best": that which errs least in the included studies. Fails with
/// Error if there is none.
WatchedPoint point_against(const std::string& asked);

/// The parts of a watch's folder (WatchSettings::out), relative to it: technique/NAME, a copy of the folder as it is
/// rendered; versions/NAME_1, ..., copies that were kept; each study's config, and the results folder beside it.
namespace watch_folder {
inline constexpr const char *technique = "technique", *versions = "versions", *kept_numbers = "numbers";
/// `kept` is a results folder of all kept versions; `now` one of what is shown, `coarse` of what is shown until the
/// truth has all its samples, `why` of where rays end, `times` of times and costs.
inline constexpr const char *now = "now", *coarse = "coarse", *why = "why", *times = "times", *kept = "kept",
                            *truth = "truth";
}  // namespace watch_folder

/// Of the truth until its full samples are there.
inline constexpr unsigned coarse_samples = 16;

/// A study of the first `scenes` scenes that measures the points, and no reflections, as `ssrlab run` takes it.
/// `samples`: of the truth. What is shown while one types is measured by one error; `is_whole`: by those that studies
/// report.
nlohmann::json numbers_study(const WatchSettings& settings, const std::vector<WatchedPoint>& points, size_t scenes,
                             unsigned samples, bool is_whole);

/// A study of the first scene that tells why a point errs: where its rays end.
nlohmann::json why_study(const WatchSettings& settings, const WatchedPoint& point);

/// One that tells what stages of the points take, here and on a GPU.
nlohmann::json times_study(const WatchSettings& settings, const std::vector<WatchedPoint>& points);
