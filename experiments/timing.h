#pragma once
#include "experiments/cell.h"
#include "experiments/config.h"
#include "experiments/frame_source.h"
#include "experiments/shot.h"

#include <functional>

struct ShotTimes {
    std::vector<TimeRow> rows;
    double aa_floor = 0;  ///< relative difference of the medians of two interleaved measurements of the same variant
};

/// Times the stages of every variant on the first frame of a shot. Variants take turns, frame by frame, so that a drift of
/// the machine's speed meets all alike, and one of them is measured twice: what its two medians differ by is noise.
/// `lit` is the colour that the variants read, RGB; `report` gets the share done.
ShotTimes time_variants(FrameSource& source, const Shot& shot, const Config& config, const HostImage& lit, bool keep_all,
                        const std::function<void(double)>& report);
