#pragma once
#include "core/gpu/passes/pass_watcher.h"
#include "experiments/gpu_costs/waves/traced_shader.h"

/// Makes the passes of a pass list record the decisions of their lanes. Passes take the forms of
/// PassList::use_gpu_forms().
class PassTracer : public PassWatcher {
public:
    using Observer = std::function<void(const PassTrace& trace)>;
    /// `observer` is called for each run of a pass.
    explicit PassTracer(Observer observer) : observer_(std::move(observer)) {}

    std::optional<InstrumentedPipeline> before(const PassRun& run) override;
    void after(const PassRun& run, std::span<const std::byte> content) override;

private:
    const Observer observer_;
    PassTrace trace_;  ///< of the running pass
    struct Traced {
        PipelineRecipe recipe;
        unsigned lane_words = 0;
    };
    std::map<std::string, Traced> traced_;  ///< by bytes of the simplified recipe
};
