#pragma once
#include "core/left_out.h"
#include "experiments/study/config/shots/shot.h"

/// What someone leaves out of a shot.
struct LeftOutBy {
    std::string who;  ///< "path tracer", "rasteriser", or a technique
    LeftOut part;
};

/// What path tracer and rasteriser leave out of a shot (nothing of a G-buffer from files), and the `techniques` in
/// their order, each with all of its points.
std::vector<LeftOutBy> left_out_of(const Shot& shot, const std::vector<PointConfig>& techniques);
