#include "experiments/gpu_costs/spirv/shader_reads.h"

#include "experiments/gpu_costs/spirv/shader_flow.h"
#include "experiments/gpu_costs/spirv/spirv_module.h"

ShaderReads reads_of(const PipelineRecipe& recipe) {
    const std::vector<unsigned> spirv = simplified(recipe).spirv.back();
    const std::vector<SpirvInstruction> instructions = spirv_instructions(spirv);
    const SpirvModule module(instructions);
    std::map<unsigned, unsigned> numbers;  // values of constants, by their ids
    ShaderReads reads;
    for (const SpirvInstruction& i : instructions) {
        if (i.op == spv::OpConstant) numbers[i[2]] = i[3];
        if (i.op == spv::OpLoad && module.definition(i[3]).op == spv::OpVariable &&
            module.storage_of(i[3]) == spv::StorageClassUniformConstant)
            reads.samplers.insert(module.name(i[3]));
        const bool is_chain = i.op == spv::OpAccessChain || i.op == spv::OpInBoundsAccessChain;
        if (!is_chain || module.definition(i[3]).op != spv::OpVariable) continue;
        const unsigned block = module.type_of(i[3])[3];
        if (module.storage_of(i[3]) == spv::StorageClassUniform && module.name(block) == "Params")
            reads.params.insert(numbers.at(i[4]));
    }
    return reads;
}
