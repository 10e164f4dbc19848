#pragma once
#include "core/cpu_times.h"
#include "core/gpu/passes/clock.h"
#include "experiments/results/cells/cell.h"
#include "experiments/study/config/config.h"
#include "experiments/study/config/shots/shot.h"
#include "experiments/study/measuring/frames/frame_source.h"
#include "metrics/statistics/median_interval.h"

#include <functional>

/// Two copies of one technique, timed in the same rounds: their medians differ by noise alone.
struct AaPair {
    std::string technique, point;
    double first_ms = 0, second_ms = 0;  ///< medians of the total

    double floor() const;  ///< their difference, relative to their mean
};

/// How much longer a stage takes in a third copy of the technique that leaves nothing out. leave_out() names all or a
/// part of the stage. The value is the difference of the medians, the largest of all timed points. None under
/// --keep-all.
struct SavedTime {
    std::string stage;
    double milliseconds = 0;
};

/// How much of a point's total time leaving out saves.
struct Saving {
    std::string technique, point;
    double complete_ms = 0;  ///< median total of the copy that leaves nothing out
    Estimate share;          ///< saved share of it, over the rounds: 1 - total / complete total
};

/// How quiet the machine was while times were taken.
struct TimingLoad {
    unsigned frames = 0;            ///< frames that count
    unsigned disturbed = 0;         ///< of these, frames in which other work exceeded disturbing_load
    unsigned left_out = 0;          ///< disturbed frames that do not count
    std::optional<double> largest;  ///< largest foreign load of counted frames; none if the system does not state it
    double stolen = 0;              ///< largest load by other virtual machines
};

struct ShotTimes {
    std::vector<TimeRow> rows;
    std::vector<AaPair> pairs;  ///< of points with time for a copy; none without config.timing.has_copies
    std::vector<SavedTime> saved;
    std::vector<Saving> savings;  ///< of points that leave anything out, if the budget allowed
    TimingLoad load;
};

/// Disturbed frames are repeated, up to this many times config.timing.frames in all.
inline constexpr unsigned most_repeated_frames = 2;

/// Times the stages of every point that is to be timed, over config.timing.frames frames after its warm-up. `budget`
/// (seconds) limits the whole. If it is too small for all:
///
/// - Every point gets least_rounds (timed_rounds.h), whatever they take.
/// - Of the copies, which show the noise of times and what leaving out saves, each technique has one of each kind and
///   the study three twins; others run as far as the budget allows.
/// - Points whose order is open after least_rounds then go on as long as the budget lasts.
///
/// Frames in which other work took more than disturbing_load of the machine's CPU time are left out if the budget
/// allows repetitions, or if enough others exist. On a busy machine the least disturbed count, and their rows say so
/// (chosen_rounds()).
///
/// A round is one frame of the shot, rendered once for all. The copies take turns in it, in an order drawn anew each
/// round, so that neither drift of the machine's speed nor what ran before favours one of them. Each copy has its own
/// images and sees every frame of timed_steps() up to its last one, so that histories are as in the shot.
///
/// `lit` gives the colour (RGB) that techniques read at a frame of shot.config.frames. `report` gets the share done.
ShotTimes time_techniques(FrameSource& source, const Shot& shot, const Config& config,
                          const std::function<const HostImage&(unsigned frame)>& lit, bool keep_all, double budget,
                          const std::function<void(double)>& report, const CpuTimesReader& cpu_times = read_cpu_times);

/// The shot's frames forwards and backwards, `count` steps in all: as in the shot, each frame is a neighbour of the one
/// before. No frame comes twice in a row at the turns, unless there is only one.
std::vector<FrameStep> timed_steps(const std::vector<unsigned>& frames, unsigned count);

/// A random order of 0 .. count - 1 for each round; the same in each run.
std::vector<std::vector<size_t>> timed_turns(size_t count, unsigned rounds);

/// ShotTimes without rows, for Cell::timing, with the proof of the clock.
nlohmann::json timing_entry(const ShotTimes& times, const std::string& shot, const ClockProof& clock);

/// Share of the counted frames that other work disturbed; 0 for null (nothing was timed).
double disturbed_share(const nlohmann::json& timing_entry);

/// Adds a timing_entry() to the manifest: clock.proofs, clock.load, clock.aa_pairs, clock.aa_floors, clock.savings, and
/// saved_ms of the shot's left_out.
void add_timing(nlohmann::json& manifest, const nlohmann::json& entry);
