#include "experiments/gpu_costs/chips/shader_work.h"

#include "core/error.h"
#include "experiments/gpu_costs/chips/occupancy.h"

#include <algorithm>
#include <cmath>

namespace {

double ratio(const std::optional<uint64_t>& a, const std::optional<uint64_t>& b) {
    return a && b && *b > 0 ? double(*a) / double(*b) : 1;
}

}  // namespace

ShaderWork shader_work(const MarkedShader& marks, const CompiledShader& original, const CompiledShader& simplified,
                       const CompiledShader& marked, const std::string& chip, const ChipRates& rates) {
    const MachineCode own = machine_code_of(simplified.assembly, simplified.lanes, rates),
                      with_marks = machine_code_of(marked.assembly, marked.lanes, rates);
    unsigned instructions = 0, padding = 0;
    for (const MachineCode::Block& block : own.blocks) instructions += block.instructions, padding += block.padding;
    // LLVM cannot read some instructions with high scalar registers, and misses the next: 8 of 3369 in the worst shader
    // that was seen, Frostbite's resolve. More would be another defect.
    const double stated = double(simplified.instructions.value_or(instructions));
    if (instructions > 1.01 * stated || instructions + padding < 0.99 * stated)
        fail("of ", stated, " instructions that the compiler states, its assembly shows ", instructions + padding);
    // Marks are left out, but they may change what the compiler makes of other instructions.
    const MachineCode& code = have_same_flow(own, with_marks) ? own : with_marks;
    const std::vector<BlockRuns> runs = runs_of(with_marks, marks);
    // By instructions: radv's sums of clocks guess how often loops run. A loop that one of the codes nests deeper
    // changes such a sum by a factor of four.
    const double size = ratio(original.instructions, simplified.instructions);
    ShaderWork result{.blocks = std::vector<ShaderWork::Block>(marks.shader_blocks), .lanes = simplified.lanes};
    if (const auto waves = occupancy_of(chip, original).waves) result.resident_waves = std::max(1u, *waves);
    for (size_t b = 0; b < runs.size(); ++b) {
        ChipWork work = code.blocks[b].work;
        work.vector *= size, work.scalar *= size, work.latency *= size;
        ShaderWork::Block& block = result.blocks[runs[b].shader_block];
        block.work.add(work, runs[b].share);
        if (runs[b].is_bound) block.uncertain.add(work, runs[b].share);
    }
    return result;
}
