#pragma once
#include "experiments/cell.h"
#include "experiments/config.h"
#include "experiments/frame_source.h"
#include "experiments/shot.h"

#include <functional>

/// Two copies of one variant, measured in the same rounds: what their medians differ by is noise.
struct AaPair {
    std::string variant, point;
    double first_ms = 0, second_ms = 0;  ///< medians of the total

    double floor() const;  ///< relative to the mean of the two
};

/// Median time of a stage that leave_out() names, in a third copy of the variant which keeps it; the largest of all
/// timed points. None under --keep-all.
struct SavedTime {
    std::string stage;
    double milliseconds = 0;
};

struct ShotTimes {
    std::vector<TimeRow> rows;
    std::vector<AaPair> pairs;  ///< one for each variant point that is timed
    std::vector<SavedTime> saved;
};

/// Times the stages of every variant point that is to be timed, over config.timing.frames frames after its warm-up.
///
/// A round is one frame of the shot, rendered once for all; the copies of the variants take turns in it, in an order
/// drawn anew each round, so that neither a drift of the machine's speed nor what ran before favours one of them. Each
/// copy has images of its own and sees every frame of timed_steps(), so that histories are as in the shot.
/// `lit` gives the colour (RGB) which the variants read at a frame; it is called for frames of shot.config.frames.
/// `report` gets the share done.
ShotTimes time_variants(FrameSource& source, const Shot& shot, const Config& config,
                        const std::function<const HostImage&(unsigned frame)>& lit, bool keep_all,
                        const std::function<void(double)>& report);

/// The shot's frames there and back again, `count` in all: as in the shot, each is a neighbour of the one before. At
/// the turns no frame comes twice in a row, unless there is only one.
std::vector<FrameStep> timed_steps(const std::vector<unsigned>& frames, unsigned count);

/// For each round an order of 0 .. count - 1, drawn at random, the same for each run.
std::vector<std::vector<size_t>> timed_turns(size_t count, unsigned rounds);

/// ShotTimes without its rows, to be kept in Cell::timing.
nlohmann::json timing_entry(const ShotTimes& times, const std::string& shot);

/// Puts what timing_entry() gave into the manifest: clock.aa_pairs, clock.aa_floor, and saved_ms of the shot's
/// left_out.
void add_timing(nlohmann::json& manifest, const nlohmann::json& entry);
