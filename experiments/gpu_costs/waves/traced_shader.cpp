#include "experiments/gpu_costs/waves/traced_shader.h"

#include "core/error.h"
#include "experiments/gpu_costs/spirv/spirv_text.h"

#include <algorithm>
#include <numeric>

namespace {

constexpr size_t header_words = sizeof(TraceLayout) / 4;

/// Parts of the shader that are written here, in the assembly of SPIR-V; names stand for the ids of their own.
/// `wave_group` and `wave_lane` are found first, by what kind of shader it is. Groups that are not chosen run the
/// shader without decisions: a decision takes lavapipe longer than a step of a march.
const char* const functions = R"(
%wave_begin = OpFunction %wave_void None %wave_begin_type
%wave_begin_start = OpLabel
%wave_groups_at = OpAccessChain %wave_pointer %wave_trace %wave_0 %wave_2
%wave_groups = OpLoad %wave_uint %wave_groups_at
%wave_chosen_at = OpAccessChain %wave_pointer %wave_trace %wave_0 %wave_3
%wave_chosen = OpLoad %wave_uint %wave_chosen_at
%wave_step_at = OpAccessChain %wave_pointer %wave_trace %wave_0 %wave_4
%wave_step = OpLoad %wave_uint %wave_step_at
%wave_lanes_at = OpAccessChain %wave_pointer %wave_trace %wave_0 %wave_5
%wave_lanes = OpLoad %wave_uint %wave_lanes_at
%wave_words_at = OpAccessChain %wave_pointer %wave_trace %wave_0 %wave_6
%wave_words = OpLoad %wave_uint %wave_words_at
@PLACE@
%wave_product = OpIMul %wave_uint %wave_group %wave_step
%wave_place = OpUMod %wave_uint %wave_product %wave_groups
%wave_is_chosen = OpULessThan %wave_bool %wave_place %wave_chosen
OpSelectionMerge %wave_begin_end None
OpBranchConditional %wave_is_chosen %wave_begin_chosen %wave_begin_end
%wave_begin_chosen = OpLabel
%wave_first_lane = OpIMul %wave_uint %wave_place %wave_lanes
%wave_record_lane = OpIAdd %wave_uint %wave_first_lane %wave_lane
%wave_record_words = OpIAdd %wave_uint %wave_words %wave_1
%wave_offset = OpIMul %wave_uint %wave_record_lane %wave_record_words
%wave_new_record = OpIAdd %wave_uint %wave_offset %wave_8
OpStore %wave_record %wave_new_record
%wave_has_run_at = OpAccessChain %wave_pointer %wave_trace %wave_0 %wave_new_record
OpStore %wave_has_run_at %wave_1
OpBranch %wave_begin_end
%wave_begin_end = OpLabel
OpReturn
OpFunctionEnd
%wave_decide = OpFunction %wave_void None %wave_decide_type
%wave_bit = OpFunctionParameter %wave_bool
%wave_decide_start = OpLabel
%wave_own = OpLoad %wave_uint %wave_record
%wave_count_at = OpAccessChain %wave_pointer %wave_trace %wave_0 %wave_own
%wave_count_and_1 = OpLoad %wave_uint %wave_count_at
%wave_next_count = OpIAdd %wave_uint %wave_count_and_1 %wave_1
OpStore %wave_count_at %wave_next_count
%wave_count = OpISub %wave_uint %wave_count_and_1 %wave_1
%wave_word = OpShiftRightLogical %wave_uint %wave_count %wave_5
%wave_most_at = OpAccessChain %wave_pointer %wave_trace %wave_0 %wave_6
%wave_most = OpLoad %wave_uint %wave_most_at
%wave_has_room = OpULessThan %wave_bool %wave_word %wave_most
%wave_is_written = OpLogicalAnd %wave_bool %wave_bit %wave_has_room
OpSelectionMerge %wave_decide_end None
OpBranchConditional %wave_is_written %wave_decide_write %wave_decide_end
%wave_decide_write = OpLabel
%wave_bit_place = OpBitwiseAnd %wave_uint %wave_count %wave_31
%wave_bit_value = OpShiftLeftLogical %wave_uint %wave_1 %wave_bit_place
%wave_word_1 = OpIAdd %wave_uint %wave_word %wave_1
%wave_word_place = OpIAdd %wave_uint %wave_own %wave_word_1
%wave_word_at = OpAccessChain %wave_pointer %wave_trace %wave_0 %wave_word_place
%wave_bits = OpLoad %wave_uint %wave_word_at
%wave_new_bits = OpBitwiseOr %wave_uint %wave_bits %wave_bit_value
OpStore %wave_word_at %wave_new_bits
OpBranch %wave_decide_end
%wave_decide_end = OpLabel
OpReturn
OpFunctionEnd
%wave_main = OpFunction %wave_void None %wave_begin_type
%wave_main_start = OpLabel
%wave_main_begin = OpFunctionCall %wave_void %wave_begin
%wave_main_record = OpLoad %wave_uint %wave_record
%wave_has_record = OpINotEqual %wave_bool %wave_main_record %wave_0
OpSelectionMerge %wave_main_end None
OpBranchConditional %wave_has_record %wave_main_chosen %wave_main_other
%wave_main_chosen = OpLabel
%wave_main_traced = OpFunctionCall %wave_void @TRACED@
OpBranch %wave_main_end
%wave_main_other = OpLabel
%wave_main_plain = OpFunctionCall %wave_void @PLAIN@
OpBranch %wave_main_end
%wave_main_end = OpLabel
OpReturn
OpFunctionEnd
)";

const char* const group_of_workgroup = R"(
%wave_row_at = OpAccessChain %wave_pointer %wave_trace %wave_0 %wave_0
%wave_row = OpLoad %wave_uint %wave_row_at
%wave_column_at = OpAccessChain %wave_pointer %wave_trace %wave_0 %wave_1
%wave_column = OpLoad %wave_uint %wave_column_at
%wave_workgroup = OpLoad %wave_uvec3 @WorkgroupId@
%wave_x = OpCompositeExtract %wave_uint %wave_workgroup 0
%wave_y = OpCompositeExtract %wave_uint %wave_workgroup 1
%wave_z = OpCompositeExtract %wave_uint %wave_workgroup 2
%wave_slices = OpIMul %wave_uint %wave_z %wave_column
%wave_rows = OpIAdd %wave_uint %wave_slices %wave_y
%wave_before = OpIMul %wave_uint %wave_rows %wave_row
%wave_group = OpIAdd %wave_uint %wave_before %wave_x
%wave_lane = OpLoad %wave_uint @LocalInvocationIndex@
)";

/// Lane: y of the quad, x of the quad, y in the quad, x in the quad, from the highest bits down.
const char* const group_of_fragment = R"(
%wave_row_at = OpAccessChain %wave_pointer %wave_trace %wave_0 %wave_0
%wave_row = OpLoad %wave_uint %wave_row_at
%wave_place_in_image = OpLoad %wave_vec4 @FragCoord@
%wave_x_float = OpCompositeExtract %wave_float %wave_place_in_image 0
%wave_y_float = OpCompositeExtract %wave_float %wave_place_in_image 1
%wave_x = OpConvertFToU %wave_uint %wave_x_float
%wave_y = OpConvertFToU %wave_uint %wave_y_float
%wave_tile_x = OpShiftRightLogical %wave_uint %wave_x %wave_3
%wave_tile_y = OpShiftRightLogical %wave_uint %wave_y %wave_3
%wave_before = OpIMul %wave_uint %wave_tile_y %wave_row
%wave_group = OpIAdd %wave_uint %wave_before %wave_tile_x
%wave_x_bit = OpBitwiseAnd %wave_uint %wave_x %wave_1
%wave_y_bit = OpBitwiseAnd %wave_uint %wave_y %wave_1
%wave_x_quads = OpShiftRightLogical %wave_uint %wave_x %wave_1
%wave_y_quads = OpShiftRightLogical %wave_uint %wave_y %wave_1
%wave_x_quad = OpBitwiseAnd %wave_uint %wave_x_quads %wave_3
%wave_y_quad = OpBitwiseAnd %wave_uint %wave_y_quads %wave_3
%wave_lane_4 = OpBitFieldInsert %wave_uint %wave_x_bit %wave_y_bit %wave_1 %wave_1
%wave_lane_16 = OpBitFieldInsert %wave_uint %wave_lane_4 %wave_x_quad %wave_2 %wave_2
%wave_lane = OpBitFieldInsert %wave_uint %wave_lane_16 %wave_y_quad %wave_4 %wave_2
)";

std::string replaced(std::string text, const std::string& what, const std::string& by) {
    const size_t at = text.find(what);
    return text.replace(at, what.size(), by);
}

}  // namespace

TraceLayout trace_layout(glm::uvec3 groups, unsigned lanes, unsigned chosen) {
    TraceLayout layout{.groups_x = groups.x, .groups_y = groups.y, .groups = groups.x * groups.y * groups.z};
    layout.lanes = lanes;
    layout.chosen = std::min(chosen, layout.groups);
    if (layout.chosen == layout.groups) return layout;
    // The golden ratio's multiples fall between each other. The shader multiplies numbers of groups in 32 bits.
    const unsigned most = std::min(layout.groups, unsigned(UINT32_MAX / layout.groups));
    layout.step = std::max(1u, unsigned(double(most) * 0.6180339887));
    while (std::gcd(layout.step, layout.groups) != 1) --layout.step;
    return layout;
}

size_t bytes_of(const TraceLayout& layout) {
    return sizeof layout + size_t(layout.chosen) * layout.lanes * (1 + layout.lane_words) * 4;
}

PipelineRecipe traced(const PipelineRecipe& simplified) {
    PipelineRecipe result = simplified;
    SpirvText text(simplified.spirv.back());
    const unsigned binding = add_storage_buffer(result, wave_trace_buffer);

    text.declare("wave_void", "OpTypeVoid");
    text.declare("wave_bool", "OpTypeBool");
    text.declare("wave_uint", "OpTypeInt 32 0");
    text.declare("wave_begin_type", "OpTypeFunction %wave_void");
    text.declare("wave_decide_type", "OpTypeFunction %wave_void %wave_bool");
    for (const unsigned number : {0, 1, 2, 3, 4, 5, 6, 8, 31})
        text.declare("wave_" + std::to_string(number), "OpConstant %wave_uint " + std::to_string(number));
    text.declare_storage_buffer("wave_trace", "wave_pointer", "%wave_uint", binding);
    text.declare("wave_private", "OpTypePointer Private %wave_uint");
    text.declare_variable("wave_record", "OpVariable %wave_private Private %wave_0");
    std::string place;
    if (result.is_compute) {
        text.declare("wave_uvec3", "OpTypeVector %wave_uint 3");
        place = replaced(group_of_workgroup, "@WorkgroupId@", text.built_in("WorkgroupId", "%wave_uvec3"));
        place = replaced(place, "@LocalInvocationIndex@", text.built_in("LocalInvocationIndex", "%wave_uint"));
    } else {
        text.declare("wave_float", "OpTypeFloat 32");
        text.declare("wave_vec4", "OpTypeVector %wave_float 4");
        place = replaced(group_of_fragment, "@FragCoord@", text.built_in("FragCoord", "%wave_vec4"));
        text.test_early_where_possible();
    }

    const std::string plain = text.add_copy(), shader = text.replace_entry_point("wave_main");
    unsigned calls = 0;
    const auto call = [&](const std::string& what) {
        return "%wave_call_" + std::to_string(++calls) + " = OpFunctionCall %wave_void " + what;
    };
    text.edit_blocks([&](SpirvText::Block& block) {
        const std::vector<std::string>& end = block.terminator;
        if (end[0] == "OpBranchConditional") block.at_end.push_back(call("%wave_decide " + end[1]));
        if (end[0] == "OpSwitch")
            for (size_t i = 3; i < end.size(); i += 2) {
                const std::string number = std::to_string(++calls), is_case = "%wave_is_case_" + number;
                const std::string type = text.type_of(end[1]);
                text.declare("wave_case_" + number, "OpConstant " + type + " " + end[i]);
                block.at_end.push_back(is_case + " = OpIEqual %wave_bool " + end[1] + " %wave_case_" + number);
                block.at_end.push_back(call("%wave_decide " + is_case));
            }
    });
    text.add_functions(replaced(replaced(replaced(functions, "@PLACE@", place), "@TRACED@", shader), "@PLAIN@", plain));
    result.spirv.back() = text.assembled();
    return result;
}

std::vector<LaneTrace> lanes_of(const TraceLayout& layout, std::span<const std::byte> content, unsigned place) {
    const std::span words(reinterpret_cast<const uint32_t*>(content.data()), content.size() / 4);
    std::vector<LaneTrace> lanes;
    for (unsigned lane = 0; lane < layout.lanes; ++lane) {
        const size_t at = header_words + (size_t(place) * layout.lanes + lane) * (1 + layout.lane_words);
        const uint32_t count = words[at];
        lanes.push_back({.has_run = count > 0,
                         .decisions = count > 0 ? count - 1 : 0,
                         .words = words.subspan(at + 1, layout.lane_words)});
    }
    return lanes;
}
