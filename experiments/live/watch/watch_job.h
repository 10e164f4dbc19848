#pragma once
#include "experiments/live/watch/running_program.h"
#include "experiments/live/watch/watch_settings.h"

#include <chrono>

/// The purposes of a watch's runs; watch_folder names their folders.
enum class JobKind { truth, coarse, now, why, times, kept };

/// `ssrlab run` of a study in its own process, so that a shader that never ends blocks that process alone. The run ends
/// with this object.
class WatchJob {
public:
    /// Writes the study's config and starts it. Results are added to the folder's. With `prunes` they replace those of
    /// other studies.
    WatchJob(JobKind kind, const WatchSettings& settings, const nlohmann::json& study, bool prunes = false);

    enum class State { running, done, failed, hanging };
    /// `hanging`: no output for WatchSettings::patience seconds, or four times as long for a job `times`, which waits
    /// for other programs. Path tracing may take any time.
    State state();
    std::string error() const;  ///< message of a failed job; several lines

    const JobKind kind;
    const std::filesystem::path results;  ///< results folder
    const std::chrono::system_clock::time_point started = std::chrono::system_clock::now();

private:
    uintmax_t said() const;  ///< bytes of output so far

    const std::filesystem::path output_, errors_;
    const double patience_;
    RunningProgram program_;
    uintmax_t said_ = 0;
    std::chrono::steady_clock::time_point since_ = std::chrono::steady_clock::now();
};
