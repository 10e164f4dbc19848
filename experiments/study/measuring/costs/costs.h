#pragma once
#include "experiments/gpu_costs/pass_cost.h"
#include "experiments/results/cells/cell.h"
#include "experiments/study/config/config.h"
#include "experiments/study/config/shots/shot.h"
#include "experiments/study/measuring/frames/frame_source.h"

#include <functional>

/// Rows of costs.csv of a frame: by stage and quantity (PassCost), and the stage `total`; none without stages.
std::vector<CostRow> cost_rows(std::vector<PassCost> costs, const std::string& shot, const PointConfig& point);

/// Counts what the passes of a point do in the last frame of a shot, with its first seed. Returns cost_rows(). Earlier
/// frames are rendered without counting, so that histories are as in the shot. As far as the technique's results depend
/// on no machine, counts do not either.
///
/// `lit` gives the colour (RGB) that the technique reads; `report` gets the share done. A technique whose rays ask the
/// scene where they end has no rows, since no engine has such passes.
std::vector<CostRow> count_costs(Device& device, const Shot& shot, FrameStore& store,
                                 const std::function<const HostImage&(const FrameStep&)>& lit,
                                 const PointConfig& technique, bool keep_all,
                                 const std::function<void(double)>& report);
