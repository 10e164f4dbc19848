#include "experiments/study/measuring/costs/compiled_shaders.h"

#include "core/error.h"
#include "experiments/gpu_costs/chips/occupancy.h"
#include "experiments/study/measuring/render_technique.h"

#include <algorithm>

namespace {

CompiledRow row_of(const StagePipelines::Entry& entry, const std::string& shot, const PointConfig& point,
                   const Chip& chip) {
    CompiledRow row;
    row.shot = shot, row.technique = point.technique, row.point = point.point;
    row.stage = entry.stage, row.pipeline = entry.number;
    row.chip = chip.name, row.driver = chip.driver;
    return row;
}

}  // namespace

void StagePipelines::collect_from(PassList& pass_list) {
    pass_list.use_gpu_forms(true);
    pass_list.watch(this);
}

void StagePipelines::add(const std::string& stage, const PipelineRecipe& recipe) {
    if (seen_.insert(stage + '\n' + bytes_of({recipe})).second)
        entries_.push_back({.stage = stage, .number = count_[stage]++, .recipe = recipe});
}

std::optional<InstrumentedPipeline> StagePipelines::before(const PassRun& run) {
    add(run.stage, run.recipe);
    return {};
}

StagePipelines stage_pipelines(Device& device, const Shot& shot, FrameStore& store,
                               const std::function<const HostImage&(const FrameStep&)>& lit, const PointConfig& point,
                               bool keep_all) {
    StagePipelines pipelines;
    const Renderer renderer(device, shot.config.extent, point);
    if (renderer.technique->uses_scene_data()) return pipelines;
    if (!keep_all) renderer.technique->leave_out(shot.facts);
    pipelines.collect_from(*renderer.pass_list);
    for (const FrameStep& step : std::span(shot.steps).first(std::min<size_t>(shot.steps.size(), 2))) {
        const FrameStore::Frame frame = store.frame(step, lit(step));
        renderer.render(frame.camera, point.seeds.front(), frame.gbuffer);
        renderer.pass_list->times();  // waits: the frame's images are gone with the next one
    }
    return pipelines;
}

std::vector<CompiledRow> compiled_rows(const StagePipelines& pipelines, const std::string& shot,
                                       const PointConfig& point, const Chip& chip, const ChipCompilation& how,
                                       std::vector<std::string>* assembly) {
    std::vector<PipelineRecipe> recipes;
    for (const StagePipelines::Entry& entry : pipelines.entries()) recipes.push_back(entry.recipe);
    const std::vector<CompiledPipeline> compiled = compile_for_chip(chip, recipes, how);
    std::vector<CompiledRow> rows;
    for (size_t i = 0; i < recipes.size(); ++i) {
        CompiledRow row = row_of(pipelines.entries()[i], shot, point, chip);
        row.refusal = compiled[i].refusal;
        if (!row.refusal.empty()) rows.push_back(row);
        for (const CompiledShader& shader : compiled[i].shaders) {
            const Occupancy occupancy = occupancy_of(chip.name, shader);
            static_cast<CompilerNumbers&>(row) = shader;
            row.shader = shader.stage, row.limit = occupancy.limit;
            row.waves = occupancy.waves, row.most_waves = occupancy.most;
            rows.push_back(row);
            if (assembly) assembly->push_back(shader.assembly);
        }
    }
    return rows;
}

GpuCompilers find_compilers(const std::vector<std::string>& names) {
    GpuCompilers compilers;
    for (const std::string& name : names) try {
            compilers.entries.push_back({.chip = find_chip(name), .refusal = {}});
        } catch (const MachineError& e) {
            compilers.entries.push_back({.chip = Chip{.name = name}, .refusal = e.what()});
        }
    return compilers;
}

std::string refusal_in(const std::vector<CompiledRow>& rows) {
    for (const CompiledRow& row : rows)
        if (!row.refusal.empty() && !row.driver.empty()) return row.stage + " for " + row.chip + ": " + row.refusal;
    return "";
}

std::vector<CompiledRow> compiled_rows(const StagePipelines& pipelines, const std::string& shot,
                                       const PointConfig& point, const GpuCompilers& compilers,
                                       const ChipCompilation& how) {
    std::vector<CompiledRow> rows;
    for (const GpuCompilers::Entry& compiler : compilers.entries) {
        if (compiler.refusal.empty()) {
            const std::vector<CompiledRow> of_chip = compiled_rows(pipelines, shot, point, compiler.chip, how);
            rows.insert(rows.end(), of_chip.begin(), of_chip.end());
            continue;
        }
        for (const StagePipelines::Entry& entry : pipelines.entries()) {
            CompiledRow row = row_of(entry, shot, point, compiler.chip);
            row.refusal = compiler.refusal;
            rows.push_back(row);
        }
    }
    return rows;
}
