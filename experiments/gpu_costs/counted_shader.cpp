#include "experiments/gpu_costs/counted_shader.h"

#include "core/error.h"
#include "experiments/gpu_costs/spirv/spirv_module.h"

#include <algorithm>
#include <array>
#include <spirv-tools/optimizer.hpp>

namespace {

using What = ShaderCounter::What;
using Id = unsigned;

constexpr std::array shader_wide = {What::invocations, What::idle_invocations, What::completed, What::writes,
                                    What::operations,  What::shared_bytes,     What::atomics};

constexpr unsigned place_of(What what) { return unsigned(std::ranges::find(shader_wide, what) - shader_wide.begin()); }

bool ends_block(spv::Op op) {
    return op == spv::OpSelectionMerge || op == spv::OpLoopMerge || (op >= spv::OpBranch && op <= spv::OpUnreachable);
}

/// Lets each function count. Numbers are known for each run of instructions without branches, and added at its end.
class Counting {
public:
    Counting(const SpirvModule& module, unsigned bound)
        : module_(module),
          bound_(bound),
          uint_(
              module.find([](const SpirvInstruction& i) { return i.op == spv::OpTypeInt && i[2] == 32 && i[3] == 0; })),
          counters_(module.named("shader_counter")),
          add_up_(module.named("shader_counters_add_up(")) {
        pointer_ = module.find([&](const SpirvInstruction& i) {
            return i.op == spv::OpTypePointer && i[2] == spv::StorageClassPrivate && i[3] == uint_;
        });
        for (const What what : shader_wide) result.push_back({what, ""});
    }

    std::vector<SpirvInstruction> counted(const std::vector<SpirvInstruction>& instructions) {
        std::vector<SpirvInstruction> before, functions;
        bool is_inside = false, is_counted = false;
        for (const SpirvInstruction& i : instructions) {
            if (i.op == spv::OpFunction) is_inside = true, is_counted = !is_own(module_.name(i[2]));
            std::vector<SpirvInstruction>& list = is_inside ? functions : before;
            if (is_counted) count(i, list);
            list.push_back(i);
        }
        leave_out_unused_sums(functions);
        for (const auto& [value, id] : constants_)
            before.push_back(spirv_instruction(spv::OpConstant, {uint_, id, value}));
        before.insert(before.end(), functions.begin(), functions.end());
        return before;
    }

    unsigned bound() const { return bound_; }
    std::vector<ShaderCounter> result;

private:
    /// Functions of the prelude that counts, and main, which calls what the shader has as such.
    static bool is_own(const std::string& name) { return name.starts_with("shader_counter") || name == "main"; }

    /// The prelude adds all counters that there can be, in their order: each takes the driver time to compile.
    void leave_out_unused_sums(std::vector<SpirvInstruction>& functions) const {
        const auto is_start = [&](const SpirvInstruction& i) { return i.op == spv::OpFunction && i[2] == add_up_; };
        auto at = std::ranges::find_if(functions, is_start);
        for (size_t calls = 0; at->op != spv::OpFunctionEnd;)
            at = at->op == spv::OpFunctionCall && ++calls > result.size() ? functions.erase(at) : at + 1;
    }

    Id constant(unsigned value) {
        const auto [entry, is_new] = constants_.try_emplace(value, bound_);
        bound_ += is_new;
        return entry->second;
    }

    void add(What what, unsigned number, const std::string& resource = {}) {
        const auto found = std::ranges::find_if(
            result, [&](const ShaderCounter& c) { return c.what == what && c.resource == resource; });
        const size_t place = size_t(found - result.begin());
        if (found == result.end()) result.push_back({what, resource});
        if (number) pending_[unsigned(place)] += number;
    }

    void count_memory(Id pointer, Id type, What in_buffer) {
        const spv::StorageClass storage = module_.storage_of(pointer);
        const bool is_write = in_buffer == What::buffer_bytes_written;
        if (storage != spv::StorageClassStorageBuffer && storage != spv::StorageClassWorkgroup) return;
        if (is_write) add(What::writes, 1);
        // A bool has no size; those of the workgroup's memory are taken for words.
        if (storage == spv::StorageClassWorkgroup)
            add(What::shared_bytes, module_.definition(type).op == spv::OpTypeBool ? 4 : module_.size(type));
        else
            add(in_buffer, module_.size(type), module_.resource(pointer));
    }

    void count(const SpirvInstruction& i, std::vector<SpirvInstruction>& list) {
        if (is_texel_fetch(i.op))
            add(What::texel_fetches, 1, module_.resource(i[3]));
        else if (is_sample(i.op))
            add(What::samples, 1, module_.resource(i[3]));
        else if (is_gather(i.op))
            add(What::gathers, 1, module_.resource(i[3]));
        else if (i.op == spv::OpImageWrite)
            add(What::texel_writes, 1, module_.resource(i[1])), add(What::writes, 1);
        else if (i.op == spv::OpLoad)
            count_memory(i[3], i[1], What::buffer_bytes_read);
        else if (i.op == spv::OpStore)
            count_memory(i[1], module_.definition(i[2])[1], What::buffer_bytes_written);
        else if (is_atomic(i.op))
            count_atomic(i);
        else
            add(What::operations, module_.operations(i));
        // What is called may discard: the numbers must be added before.
        if (ends_block(i.op) || i.op == spv::OpFunctionCall) add_pending(list);
        if (i.op == spv::OpKill)
            list.push_back(spirv_instruction(spv::OpFunctionCall, {module_.definition(add_up_)[1], bound_++, add_up_}));
    }

    void count_atomic(const SpirvInstruction& i) {
        const Id pointer = i.op == spv::OpAtomicStore ? i[1] : i[3];
        add(What::atomics, 1);
        if (module_.storage_of(pointer) == spv::StorageClassImage) {
            add(What::texel_fetches, 1, module_.resource(pointer)),
                add(What::texel_writes, 1, module_.resource(pointer));
            return add(What::writes, 1);
        }
        const Id type = module_.type_of(pointer)[3];
        count_memory(pointer, type, What::buffer_bytes_read), count_memory(pointer, type, What::buffer_bytes_written);
    }

    void add_pending(std::vector<SpirvInstruction>& list) {
        for (const auto& [place, number] : pending_) {
            const Id pointer = bound_++, before = bound_++, after = bound_++;
            list.push_back(spirv_instruction(spv::OpAccessChain, {pointer_, pointer, counters_, constant(place)}));
            list.push_back(spirv_instruction(spv::OpLoad, {uint_, before, pointer}));
            list.push_back(spirv_instruction(spv::OpIAdd, {uint_, after, before, constant(number)}));
            list.push_back(spirv_instruction(spv::OpStore, {pointer, after}));
        }
        pending_.clear();
    }

    const SpirvModule& module_;
    Id bound_;
    Id uint_, counters_, add_up_, pointer_ = 0;
    std::map<unsigned, Id> constants_;      ///< by value
    std::map<unsigned, unsigned> pending_;  ///< by the counter's place
};

/// Images that are arguments of functions are identified only after inlining.
void inline_functions_of_images(std::vector<unsigned>& spirv, const std::vector<SpirvInstruction>& instructions) {
    const SpirvModule module(instructions);
    const auto is_image = [&](const SpirvInstruction& i) {
        return i.op == spv::OpFunctionParameter && module.definition(i[1]).op == spv::OpTypePointer &&
               module.definition(i[1])[2] == spv::StorageClassUniformConstant;
    };
    if (std::ranges::none_of(instructions, is_image)) return;
    spvtools::Optimizer optimizer(SPV_ENV_VULKAN_1_2);
    optimizer.RegisterPass(spvtools::CreateMergeReturnPass()).RegisterPass(spvtools::CreateInlineOpaquePass());
    optimizer.RegisterPass(spvtools::CreateEliminateDeadFunctionsPass());
    if (!optimizer.Run(spirv.data(), spirv.size(), &spirv)) fail("a shader to be counted cannot be simplified");
}

}  // namespace

std::string with_counters(const std::string& glsl) {
    const std::string count = std::to_string(most_shader_counters);
    const auto counter = [](What what) { return "shader_counter[" + std::to_string(place_of(what)) + "]"; };
    std::string zeros, sums;
    for (unsigned i = 0; i < most_shader_counters; ++i) {
        const std::string place = std::to_string(i);
        zeros += "    shader_counter[" + place + "] = 0u;\n";
        sums += "    shader_counters_add(" + place + ", shader_counter[" + place + "]);\n";
    }
    return "buffer " + std::string(shader_counts_buffer) + " { uint shader_count[2 * " + count + "]; };\n" +
           "uint shader_counter[" + count + "];\n" + R"(
void shader_counters_add(uint place, uint number) {
    if (number == 0u) return;
    uint before = atomicAdd(shader_count[2u * place], number);
    if (before + number < before) atomicAdd(shader_count[2u * place + 1u], 1u);
}
void shader_counters_add_up() {
    )" + counter(What::invocations) +
           " = 1u;\n" + sums + "}\n#define main counted_main\n" + glsl + "\n#undef main\nvoid main() {\n" + zeros +
           "    counted_main();\n    " + counter(What::completed) + " = 1u;\n#ifdef COMPUTE_SHADER\n    " +
           counter(What::idle_invocations) + " = " + counter(What::writes) +
           " == 0u ? 1u : 0u;\n#endif\n    shader_counters_add_up();\n}\n";
}

std::vector<ShaderCounter> count_in(std::vector<unsigned>& spirv) {
    inline_functions_of_images(spirv, spirv_instructions(spirv));
    const std::vector<SpirvInstruction> instructions = spirv_instructions(spirv);
    const SpirvModule module(instructions);
    Counting counting(module, spirv[spirv_bound_word]);
    const std::vector<SpirvInstruction> counted = counting.counted(instructions);
    if (counting.result.size() > most_shader_counters)
        fail("a counted shader has ", counting.result.size(), " numbers to count, and ", most_shader_counters,
             " at most");
    const bool is_early = is_tested_early(instructions);
    spirv.resize(spirv_header_words);
    spirv[spirv_bound_word] = counting.bound();
    for (const SpirvInstruction& i : counted) {
        spirv.insert(spirv.end(), i.words.begin(), i.words.end());
        if (i.op == spv::OpEntryPoint && is_early) {
            const SpirvInstruction mode =
                spirv_instruction(spv::OpExecutionMode, {i[2], spv::ExecutionModeEarlyFragmentTests});
            spirv.insert(spirv.end(), mode.words.begin(), mode.words.end());
        }
    }
    return counting.result;
}
