#pragma once
#include "experiments/gpu_costs/pass_cost.h"
#include "experiments/gpu_costs/waves/wave_replay.h"
#include "experiments/study/config/config.h"
#include "experiments/study/config/shots/shot.h"
#include "experiments/study/measuring/frames/frame_source.h"

#include <functional>
#include <map>

/// What a point's passes did in the last frame of a shot, with its first seed, in their forms for GPUs.
struct TracedFrame {
    struct Pass {
        std::string stage;
        PipelineRecipe original, recipe;  ///< as the pass has it, and as simplified() gave it
        ShaderFlow flow;
        unsigned groups = 0;  ///< all of the pass
        /// By the lanes of a wave: what the waves of each group did that was traced.
        std::map<unsigned, std::vector<WaveCounts>> traced;
    };
    std::vector<Pass> passes;     ///< each run of each
    std::vector<PassCost> costs;  ///< by stage
};

/// Renders the shot twice: the last frame is counted once and traced once. Empty of a technique whose rays ask the
/// scene where they truly end. `lit` gives the colour (RGB) that the technique reads; `report` gets the share done.
TracedFrame trace_last_frame(Device& device, const Shot& shot, FrameStore& store,
                             const std::function<const HostImage&(const FrameStep&)>& lit, const PointConfig& point,
                             bool keep_all, const std::function<void(double)>& report);
