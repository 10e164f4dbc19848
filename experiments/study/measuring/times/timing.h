#pragma once
#include "core/cpu_times.h"
#include "core/gpu/passes/clock.h"
#include "experiments/results/cells/cell.h"
#include "experiments/study/config/config.h"
#include "experiments/study/config/shots/shot.h"
#include "experiments/study/measuring/frames/frame_source.h"
#include "metrics/statistics/median_interval.h"

#include <functional>

/// Two copies of one technique, measured in the same rounds: what their medians differ by is noise.
struct AaPair {
    std::string technique, point;
    double first_ms = 0, second_ms = 0;  ///< medians of the total

    double floor() const;  ///< relative to the mean of the two
};

/// How much longer a stage, of which leave_out() names all or a part, takes in a third copy of the technique which
/// leaves nothing out: the difference of the medians, the largest of all timed points. None under --keep-all.
struct SavedTime {
    std::string stage;
    double milliseconds = 0;
};

/// What leaving out saves a technique point of its total.
struct Saving {
    std::string technique, point;
    double complete_ms = 0;  ///< median total of the copy that leaves nothing out
    Estimate share;          ///< of that, over the rounds: 1 - total / complete total
};

/// How quiet the machine was while times were taken.
struct TimingLoad {
    unsigned frames = 0;            ///< that count
    unsigned disturbed = 0;         ///< of these, in which others took more than disturbing_load of the machine
    unsigned left_out = 0;          ///< disturbed frames that do not count
    std::optional<double> largest;  ///< foreign load of the frames that count; none where the system does not tell
    double stolen = 0;              ///< the largest part of it that other virtual machines took
};

struct ShotTimes {
    std::vector<TimeRow> rows;
    std::vector<AaPair> pairs;  ///< of the points that had the time for one; none without config.timing.has_copies
    std::vector<SavedTime> saved;
    std::vector<Saving> savings;  ///< of points that leave anything out, if there was the time
    TimingLoad load;
};

/// Frames that were disturbed are followed by others in their place, up to this many times config.timing.frames.
inline constexpr unsigned most_repeated_frames = 2;

/// Times the stages of every technique point that is to be timed, over config.timing.frames frames after its warm-up,
/// if `budget` (seconds, all in all) is enough. Where it is not, every point gets least_rounds (timed_rounds.h),
/// whatever they take; of the copies, which tell the noise of times and what leaving out saves, each technique has one
/// of each kind, the study three twins, and the others as far as the budget allows; then the points whose order is open
/// after least_rounds go on as long as the budget lasts. Frames in which other work took more than disturbing_load of
/// the machine's CPU time are left out as long as the budget lasts for later ones in their place, or if enough others
/// are there; where the machine stays busy the least disturbed count, and their rows say so (chosen_rounds()).
///
/// A round is one frame of the shot, rendered once for all; the copies of the techniques take turns in it, in an order
/// drawn anew each round, so that neither a drift of the machine's speed nor what ran before favours one of them. Each
/// copy has images of its own and sees every frame of timed_steps() up to its last one, so that histories are as in
/// the shot.
/// `lit` gives the colour (RGB) which the techniques read at a frame; it is called for frames of shot.config.frames.
/// `report` gets the share done.
ShotTimes time_techniques(FrameSource& source, const Shot& shot, const Config& config,
                          const std::function<const HostImage&(unsigned frame)>& lit, bool keep_all, double budget,
                          const std::function<void(double)>& report, const CpuTimesReader& cpu_times = read_cpu_times);

/// The shot's frames there and back again, `count` in all: as in the shot, each is a neighbour of the one before. At
/// the turns no frame comes twice in a row, unless there is only one.
std::vector<FrameStep> timed_steps(const std::vector<unsigned>& frames, unsigned count);

/// For each round an order of 0 .. count - 1, drawn at random, the same for each run.
std::vector<std::vector<size_t>> timed_turns(size_t count, unsigned rounds);

/// ShotTimes without its rows, to be kept in Cell::timing, with the proof of the clock that took them.
nlohmann::json timing_entry(const ShotTimes& times, const std::string& shot, const ClockProof& clock);

/// Which share of the frames that count was disturbed by other work; 0 of null, where nothing was timed.
double disturbed_share(const nlohmann::json& timing_entry);

/// Puts what timing_entry() gave into the manifest: clock.proofs, clock.load, clock.aa_pairs, clock.aa_floors,
/// clock.savings, and saved_ms of the shot's left_out.
void add_timing(nlohmann::json& manifest, const nlohmann::json& entry);
