#pragma once
#include "core/gpu/passes/pass_watcher.h"
#include "experiments/gpu_costs/waves/traced_shader.h"

/// Lets the passes of a pass_list write down what their lanes decide. Passes take the forms that
/// PassList::use_gpu_forms() says.
class PassTracer : public PassWatcher {
public:
    using Observer = std::function<void(const PassTrace& trace)>;
    /// `observer` hears of each run of a pass.
    explicit PassTracer(Observer observer) : observer_(std::move(observer)) {}

    std::optional<InstrumentedPipeline> before(const PassRun& run) override;
    void after(const PassRun& run, std::vector<std::byte> content) override;

private:
    const Observer observer_;
    PassTrace trace_;                               ///< of the pass that runs
    std::map<std::string, PipelineRecipe> traced_;  ///< by the bytes of their simplified recipes
};
