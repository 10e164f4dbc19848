#pragma once
#include "core/gpu/passes/pass_watcher.h"
#include "experiments/gpu_costs/chips/chip_compiler.h"
#include "experiments/results/cells/cell.h"
#include "experiments/study/config/config.h"
#include "experiments/study/config/shots/shot.h"
#include "experiments/study/measuring/frames/frame_source.h"

#include <map>
#include <set>

/// The pipelines that stages of a frame use, each once, in the order in which they first ran.
class StagePipelines : private PassWatcher {
public:
    /// Hears of all passes of `pass_list` from now on, which take the forms that they have for GPUs. It must outlive
    /// what the pass_list renders.
    void collect_from(PassList& pass_list);

    struct Entry {
        std::string stage;
        unsigned number;  ///< within its stage
        PipelineRecipe recipe;
    };
    const std::vector<Entry>& entries() const { return entries_; }

private:
    std::optional<InstrumentedPipeline> before(const PassRun& run) override;

    std::vector<Entry> entries_;
    std::set<std::string> seen_;
    std::map<std::string, unsigned> count_;
};

/// Of the first two frames of a shot, which know no history and one. Empty of a technique whose rays ask the scene
/// where they truly end: it stands for no passes that an engine could have. `lit` gives the colour (RGB) that the
/// technique reads.
StagePipelines stage_pipelines(Device& device, const Shot& shot, FrameStore& store,
                               const std::function<const HostImage&(const FrameStep&)>& lit, const PointConfig& point,
                               bool keep_all);

/// The chips that a study compiles for.
struct GpuCompilers {
    struct Entry {
        Chip chip;            ///< without device and driver where there is a refusal
        std::string refusal;  ///< why nothing can be compiled for it on this machine; the study goes on
    };
    std::vector<Entry> entries;
};
/// Fails with Error on a chip that radv does not know.
GpuCompilers find_compilers(const std::vector<std::string>& chips);

/// Why a compiler that is there gave no numbers of a shader; "" if there is no such. It may have been killed, or lacked
/// memory: another try may succeed.
std::string refusal_in(const std::vector<CompiledRow>& rows);

/// compiled_rows() of all chips; of those with a refusal a row for each stage, which has no numbers.
std::vector<CompiledRow> compiled_rows(const StagePipelines& pipelines, const std::string& shot,
                                       const PointConfig& point, const GpuCompilers& compilers,
                                       const ChipCompilation& how);

/// What the compiler of `chip` makes of the pipelines: rows of compiled.csv, of the shot of that name. With
/// `how.has_assembly`, `assembly` gets each row's text.
std::vector<CompiledRow> compiled_rows(const StagePipelines& pipelines, const std::string& shot,
                                       const PointConfig& point, const Chip& chip, const ChipCompilation& how,
                                       std::vector<std::string>* assembly = nullptr);
