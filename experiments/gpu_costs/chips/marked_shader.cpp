#include "experiments/gpu_costs/chips/marked_shader.h"

#include "core/error.h"
#include "experiments/gpu_costs/spirv/spirv_text.h"

namespace {

constexpr unsigned kept_operations = 12;  // more than 8, since some of what the module states is left out

/// By block. What leads to a kept block and nowhere around it is kept with it.
std::vector<bool> kept_blocks(const ShaderFlow& flow) {
    std::vector<bool> kept;
    for (const ShaderFlow::Block& b : flow.blocks)
        kept.push_back(kept.empty() || b.is_loop_header || b.has_memory || b.operations >= kept_operations);
    const std::vector<unsigned> before = nearest_dominators(graph_of(flow));
    for (size_t b = 0; b < kept.size(); ++b)
        for (size_t over = before[b]; kept[b] && over < kept.size(); over = before[over]) kept[over] = true;
    return kept;
}

}  // namespace

MarkedShader marked(const PipelineRecipe& simplified, const ShaderFlow& flow) {
    MarkedShader result{.recipe = simplified, .blocks = {}, .shader_blocks = flow.blocks.size()};
    SpirvText text(simplified.spirv.back());
    const unsigned binding = add_storage_buffer(result.recipe, "marks");
    text.declare("mark_uint", "OpTypeInt 32 0");
    text.declare("mark_0", "OpConstant %mark_uint 0");
    text.declare_storage_buffer("marks", "mark_pointer", "%mark_uint", binding);
    const std::vector<bool> kept = kept_blocks(flow);
    size_t place = 0;
    text.edit_blocks([&](SpirvText::Block& block) {
        const size_t here = place++;
        if (!kept[here]) return;
        const unsigned offset = first_mark_offset + 4 * unsigned(result.blocks.size());
        if (offset >= mark_offset_limit) fail("a shader has too many blocks to be marked");
        const std::string number = std::to_string(result.blocks.size()), at = "%mark_at_" + number;
        text.declare("mark_place_" + number, "OpConstant %mark_uint " + std::to_string(offset / 4));
        block.at_start.push_back(at + " = OpAccessChain %mark_pointer %marks %mark_0 %mark_place_" + number);
        block.at_start.push_back("OpStore " + at + " %mark_0 Volatile");
        result.blocks.push_back(unsigned(here));
    });
    result.recipe.spirv.back() = text.assembled();
    return result;
}
