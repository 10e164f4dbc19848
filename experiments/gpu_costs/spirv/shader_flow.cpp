#include "experiments/gpu_costs/spirv/shader_flow.h"

#include "core/error.h"
#include "experiments/gpu_costs/spirv/spirv_module.h"

#include <algorithm>
#include <functional>
#include <spirv-tools/optimizer.hpp>

namespace {

bool reads_or_writes_memory(const SpirvModule& module, const SpirvInstruction& i) {
    const auto is_memory = [&](unsigned pointer) {
        const spv::StorageClass storage = module.storage_of(pointer);
        return storage == spv::StorageClassStorageBuffer || storage == spv::StorageClassWorkgroup;
    };
    if (i.op >= spv::OpImageSampleImplicitLod && i.op <= spv::OpImageWrite) return true;
    if (is_atomic(i.op)) return true;
    if (i.op == spv::OpLoad) return is_memory(i[3]);
    if (i.op == spv::OpStore) return is_memory(i[1]);
    return i.op == spv::OpControlBarrier ||
           (i.op >= spv::OpGroupNonUniformElect && i.op <= spv::OpGroupNonUniformQuadSwap);
}

/// The structured order of SPIR-V ("Structured Control Flow"): depth first, what follows a construct before what it
/// holds, and backwards.
void set_ranks(ShaderFlow& flow, const std::map<unsigned, std::vector<unsigned>>& behind) {
    std::vector<bool> is_seen(flow.blocks.size(), false);
    unsigned rank = unsigned(flow.blocks.size());
    const std::function<void(unsigned)> visit = [&](unsigned block) {
        if (is_seen[block]) return;
        is_seen[block] = true;
        if (const auto targets = behind.find(block); targets != behind.end())
            for (const unsigned target : targets->second) visit(target);
        for (const unsigned next : flow.blocks[block].successors) visit(next);
        flow.blocks[block].rank = --rank;
    };
    visit(0);
}

}  // namespace

PipelineRecipe simplified(const PipelineRecipe& recipe) {
    PipelineRecipe result = recipe;
    std::unordered_map<uint32_t, std::vector<uint32_t>> constants;
    for (const auto& [id, value] : recipe.constants) constants[id] = {value};
    // None of these passes changes the order of arithmetic, as CreateSimplificationPass() would.
    spvtools::Optimizer optimizer(SPV_ENV_VULKAN_1_2);
    optimizer.RegisterPass(spvtools::CreateSetSpecConstantDefaultValuePass(constants))
        .RegisterPass(spvtools::CreateFreezeSpecConstantValuePass())
        .RegisterPass(spvtools::CreateFoldSpecConstantOpAndCompositePass())
        .RegisterPass(spvtools::CreateMergeReturnPass())
        .RegisterPass(spvtools::CreateInlineExhaustivePass())
        .RegisterPass(spvtools::CreateEliminateDeadFunctionsPass())
        .RegisterPass(spvtools::CreateCCPPass())
        .RegisterPass(spvtools::CreateDeadBranchElimPass())
        .RegisterPass(spvtools::CreateBlockMergePass())
        .RegisterPass(spvtools::CreateEliminateDeadConstantPass());
    std::vector<unsigned>& spirv = result.spirv.back();
    if (!optimizer.Run(spirv.data(), spirv.size(), &spirv)) fail("a shader cannot be written as one function");
    if (recipe.is_compute) result.constants.clear();
    return result;
}

ShaderFlow flow_of(const PipelineRecipe& simplified) {
    const std::vector<SpirvInstruction> instructions = spirv_instructions(simplified.spirv.back());
    const SpirvModule module(instructions);
    ShaderFlow flow;
    std::map<unsigned, unsigned> places;
    std::map<unsigned, std::vector<unsigned>> behind;  ///< of a construct's first block: its merge and continue target
    for (const SpirvInstruction& i : instructions)
        if (i.op == spv::OpLabel) {
            places[i[1]] = unsigned(flow.blocks.size());
            flow.blocks.push_back({.label = i[1]});
        }
    unsigned functions = 0;
    ShaderFlow::Block* block = nullptr;
    for (const SpirvInstruction& i : instructions) {
        functions += i.op == spv::OpFunction;
        if (i.op == spv::OpLabel) block = &flow.blocks[places.at(i[1])];
        if (!block) continue;
        block->operations += module.operations(i);
        const bool is_image_atomic =
            is_atomic(i.op) && i.op != spv::OpAtomicStore && module.storage_of(i[3]) == spv::StorageClassImage;
        block->fetches += is_sample(i.op) || is_gather(i.op) || is_texel_fetch(i.op) || is_image_atomic;
        block->has_memory = block->has_memory || reads_or_writes_memory(module, i);
        block->is_loop_header = block->is_loop_header || i.op == spv::OpLoopMerge;
        const unsigned here = unsigned(block - flow.blocks.data());
        if (i.op == spv::OpSelectionMerge) behind[here] = {places.at(i[1])};
        if (i.op == spv::OpLoopMerge) behind[here] = {places.at(i[1]), places.at(i[2])};
        if (i.op == spv::OpBranch) block->successors = {places.at(i[1])};
        if (i.op == spv::OpBranchConditional) {
            block->successors = {places.at(i[2]), places.at(i[3])};
            block->decisions = 1;
        }
        if (i.op == spv::OpSwitch) {
            for (size_t word = 4; word < i.words.size(); word += 2) block->successors.push_back(places.at(i[word]));
            block->decisions = unsigned(block->successors.size());
            block->successors.push_back(places.at(i[2]));
        }
    }
    if (functions != 1) fail("a shader of ", functions, " functions cannot be followed");
    set_ranks(flow, behind);
    return flow;
}

FlowGraph graph_of(const ShaderFlow& flow) {
    FlowGraph graph(flow.blocks.size());
    for (size_t b = 0; b < flow.blocks.size(); ++b)
        for (const unsigned next : flow.blocks[b].successors) graph.add_edge(b, next);
    return graph;
}

unsigned add_storage_buffer(PipelineRecipe& recipe, const std::string& name) {
    unsigned binding = 0;
    for (const ShaderInterface::Resource& r : recipe.resources) binding = std::max(binding, r.binding + 1);
    recipe.resources.push_back({name, binding, ShaderInterface::Kind::storage, false});
    return binding;
}
