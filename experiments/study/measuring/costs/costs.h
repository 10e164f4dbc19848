#pragma once
#include "experiments/results/cells/cell.h"
#include "experiments/study/config/config.h"
#include "experiments/study/config/shots/shot.h"
#include "experiments/study/measuring/frames/frame_source.h"

#include <functional>

/// What the passes of a technique point do in the last frame of a shot, with its first seed: rows of costs.csv, by
/// stage and quantity (PassCost), and the stage `total`. The frames before it are rendered without counting, so that
/// histories are as in the shot. Counts depend on no machine, as far as the technique's results do not.
///
/// `lit` gives the colour (RGB) that the technique reads; `report` gets the share done. Nothing is counted of a
/// technique whose rays ask the scene where they truly end: it stands for no passes that an engine could have.
std::vector<CostRow> count_costs(Device& device, const Shot& shot, FrameStore& store,
                                 const std::function<const HostImage&(const FrameStep&)>& lit,
                                 const PointConfig& technique, bool keep_all,
                                 const std::function<void(double)>& report);
