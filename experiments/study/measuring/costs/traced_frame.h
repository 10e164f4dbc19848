#pragma once
#include "experiments/gpu_costs/pass_cost.h"
#include "experiments/gpu_costs/waves/wave_replay.h"
#include "experiments/study/config/config.h"
#include "experiments/study/config/shots/shot.h"
#include "experiments/study/measuring/costs/compiled_shaders.h"
#include "experiments/study/measuring/frames/frame_source.h"

#include <functional>
#include <map>

/// A record of a point's passes, in their forms for GPUs, in the last frame of a shot with its first seed.
struct TracedFrame {
    struct Pass {
        std::string stage;
        PipelineRecipe original, recipe;  ///< the pass's own, and simplified() of it
        ShaderFlow flow;
        unsigned groups = 0;  ///< number of groups in the pass
        /// By lanes of a wave: counts of the waves of each traced group.
        std::map<unsigned, std::vector<WaveCounts>> traced;
    };
    std::vector<Pass> passes;      ///< one entry for each run of a pass
    std::vector<PassCost> costs;   ///< by stage
    bool is_of_gpu_forms = false;  ///< whether `costs` may differ from those of the technique's forms for CPUs
    StagePipelines pipelines;      ///< of the frames before the last, and of the last
};

/// Renders the shot twice: its last frame is counted once and traced once. Empty for a technique whose rays ask the
/// scene where they end. `lit` gives the colour (RGB) that the technique reads; `report` gets the share done.
TracedFrame trace_last_frame(Device& device, const Shot& shot, FrameStore& store,
                             const std::function<const HostImage&(const FrameStep&)>& lit, const PointConfig& point,
                             bool keep_all, const std::function<void(double)>& report);
