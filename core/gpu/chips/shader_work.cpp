#include "core/gpu/chips/shader_work.h"

#include "core/error.h"
#include "core/gpu/chips/occupancy.h"

#include <algorithm>

ShaderWork shader_work(const MarkedShader& marks, const CompiledShader& plain, const CompiledShader& marked,
                       const std::string& chip, const ChipRates& rates) {
    const MachineCode own = machine_code_of(plain.assembly, plain.lanes, rates),
                      with_marks = machine_code_of(marked.assembly, marked.lanes, rates);
    unsigned instructions = 0;
    for (const MachineCode::Block& block : own.blocks) instructions += block.instructions;
    if (plain.instructions && instructions != *plain.instructions)
        fail("of ", *plain.instructions, " instructions that the compiler states, its assembly shows ", instructions);
    // Marks are left out, but they may change what the compiler makes of other instructions.
    const MachineCode& code = have_same_flow(own, with_marks) ? own : with_marks;
    const std::vector<BlockRuns> runs = runs_of(with_marks, marks);
    ShaderWork result{.blocks = std::vector<ShaderWork::Block>(marks.shader_blocks), .lanes = plain.lanes};
    if (const auto waves = occupancy_of(chip, plain).waves) result.resident_waves = std::max(1u, *waves);
    for (size_t b = 0; b < runs.size(); ++b) {
        ShaderWork::Block& block = result.blocks[runs[b].shader_block];
        block.work.add(code.blocks[b].work, runs[b].share);
        if (runs[b].is_bound) block.uncertain.add(code.blocks[b].work, runs[b].share);
    }
    return result;
}
