#pragma once
#include "core/gpu/passes/pass_watcher.h"
#include "experiments/gpu_costs/chips/chip_compiler.h"
#include "experiments/results/cells/cell.h"
#include "experiments/study/config/config.h"
#include "experiments/study/config/shots/shot.h"
#include "experiments/study/measuring/frames/frame_source.h"

#include <map>
#include <set>

/// The pipelines that a frame's stages use, each once, in the order of first use.
class StagePipelines : private PassWatcher {
public:
    /// Collects the pipelines of all later passes of `pass_list`, which then take their forms for GPUs. This object
    /// must outlive the rendering.
    void collect_from(PassList& pass_list);
    /// The pipeline of one more run of a pass.
    void add(const std::string& stage, const PipelineRecipe& recipe);

    struct Entry {
        std::string stage;
        unsigned number;  ///< counts pipelines within the stage
        PipelineRecipe recipe;
    };
    const std::vector<Entry>& entries() const { return entries_; }

private:
    std::optional<InstrumentedPipeline> before(const PassRun& run) override;

    std::vector<Entry> entries_;
    std::set<std::string> seen_;
    std::map<std::string, unsigned> count_;
};

/// The pipelines of a shot's first two frames: one without history, one with history. Empty for a technique whose rays
/// ask the scene where they end, since no engine has such passes. `lit` gives the colour (RGB) that the technique
/// reads.
StagePipelines stage_pipelines(Device& device, const Shot& shot, FrameStore& store,
                               const std::function<const HostImage&(const FrameStep&)>& lit, const PointConfig& point,
                               bool keep_all);

/// The chips that a study compiles for.
struct GpuCompilers {
    struct Entry {
        Chip chip;            ///< without device and driver where there is a refusal
        std::string refusal;  ///< why this machine cannot compile for the chip; the study goes on
    };
    std::vector<Entry> entries;
};
/// Fails with Error on a chip that radv does not know.
GpuCompilers find_compilers(const std::vector<std::string>& chips);

/// Why an installed compiler gave no numbers for a shader; "" if all have numbers. The compiler may have been killed or
/// lacked memory: another try may succeed.
std::string refusal_in(const std::vector<CompiledRow>& rows);

/// compiled_rows() of all chips. A chip with a refusal has one row for each stage, without numbers.
std::vector<CompiledRow> compiled_rows(const StagePipelines& pipelines, const std::string& shot,
                                       const PointConfig& point, const GpuCompilers& compilers,
                                       const ChipCompilation& how);

/// Compiles the pipelines for `chip`: rows of compiled.csv of this shot. With `how.has_assembly`, `assembly` gets each
/// row's text.
std::vector<CompiledRow> compiled_rows(const StagePipelines& pipelines, const std::string& shot,
                                       const PointConfig& point, const Chip& chip, const ChipCompilation& how,
                                       std::vector<std::string>* assembly = nullptr);
