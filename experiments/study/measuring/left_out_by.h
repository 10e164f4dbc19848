#pragma once
#include "core/left_out.h"
#include "experiments/study/config/shots/shot.h"

/// A part of the work on a shot that one renderer leaves out.
struct LeftOutBy {
    std::string who;  ///< "path tracer", "rasteriser", or a technique
    LeftOut part;
};

/// What path tracer and rasteriser leave out of a shot (nothing of a G-buffer from files), then each of `techniques`
/// with all of its points, in their order.
std::vector<LeftOutBy> left_out_of(const Shot& shot, const std::vector<PointConfig>& techniques);
