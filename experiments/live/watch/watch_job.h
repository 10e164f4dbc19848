#pragma once
#include "experiments/live/watch/running_program.h"
#include "experiments/live/watch/watch_settings.h"

#include <chrono>

/// What a run of a watch is for: watch_folder has their folders.
enum class JobKind { truth, coarse, now, why, times, kept };

/// `ssrlab run` of a study, beside this program: a shader that never ends takes that one with it, and no more. Ended
/// when this object goes.
class WatchJob {
public:
    /// Writes the study's config and starts it. Its results are added to those that the folder has, in place of those
    /// of other studies if it `prunes`.
    WatchJob(JobKind kind, const WatchSettings& settings, const nlohmann::json& study, bool prunes = false);

    enum class State { running, done, failed, hanging };
    /// `hanging`: it has said nothing for WatchSettings::patience seconds, four times that of a job `times`, which
    /// waits for other programs. Path tracing goes on as long as it takes.
    State state();
    std::string error() const;  ///< what a failed one said; of several lines

    const JobKind kind;
    const std::filesystem::path results;  ///< its folder
    const std::chrono::system_clock::time_point started = std::chrono::system_clock::now();

private:
    uintmax_t said() const;  ///< bytes

    const std::filesystem::path output_, errors_;
    const double patience_;
    RunningProgram program_;
    uintmax_t said_ = 0;
    std::chrono::steady_clock::time_point since_ = std::chrono::steady_clock::now();
};
