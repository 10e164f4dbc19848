#pragma once
#include "experiments/results/cells/cell.h"
#include "experiments/study/config/config.h"
#include "experiments/study/config/shots/shot.h"
#include "experiments/study/measuring/frames/frame_source.h"

#include <functional>

/// Counts what the passes of a point do in the last frame of a shot, with its first seed. Returns rows of costs.csv by
/// stage and quantity (PassCost), and the stage `total`. Earlier frames are rendered without counting, so that
/// histories are as in the shot. As far as the technique's results depend on no machine, counts do not either.
///
/// `lit` gives the colour (RGB) that the technique reads; `report` gets the share done. A technique whose rays ask the
/// scene where they end has no rows, since no engine has such passes.
std::vector<CostRow> count_costs(Device& device, const Shot& shot, FrameStore& store,
                                 const std::function<const HostImage&(const FrameStep&)>& lit,
                                 const PointConfig& technique, bool keep_all,
                                 const std::function<void(double)>& report);
