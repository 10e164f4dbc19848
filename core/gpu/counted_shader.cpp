#include "core/gpu/counted_shader.h"

#include "core/error.h"

#define SPV_ENABLE_UTILITY_CODE
#include <SPIRV/spirv.hpp>
#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <spirv-tools/optimizer.hpp>

namespace {

using What = ShaderCounter::What;
using Id = unsigned;

constexpr std::array shader_wide = {What::invocations, What::idle_invocations, What::completed, What::writes,
                                    What::operations,  What::shared_bytes,     What::atomics};

constexpr unsigned place_of(What what) { return unsigned(std::ranges::find(shader_wide, what) - shader_wide.begin()); }

struct Instruction {
    spv::Op op;
    std::vector<unsigned> words;  ///< the first holds length and opcode

    unsigned operator[](size_t i) const { return words[i]; }
    std::string text(size_t from) const {
        std::string text;
        for (size_t i = from; i < words.size(); ++i)
            for (int byte = 0; byte < 4; ++byte) {
                const char c = char(words[i] >> (8 * byte) & 255);
                if (!c) return text;
                text += c;
            }
        return text;
    }
};

Instruction instruction(spv::Op op, std::vector<unsigned> operands) {
    operands.insert(operands.begin(), unsigned(operands.size() + 1) << 16 | unsigned(op));
    return {op, std::move(operands)};
}

constexpr size_t header_words = 5, bound_word = 3;

std::vector<Instruction> instructions_of(const std::vector<unsigned>& spirv) {
    std::vector<Instruction> list;
    for (size_t at = header_words; at < spirv.size(); at += spirv[at] >> 16)
        list.push_back(
            {spv::Op(spirv[at] & 0xffff), {spirv.begin() + long(at), spirv.begin() + long(at + (spirv[at] >> 16))}});
    return list;
}

/// What the module's ids stand for.
class Module {
public:
    explicit Module(const std::vector<Instruction>& instructions) {
        for (const Instruction& i : instructions) {
            if (i.op == spv::OpName) names_[i[1]] = i.text(2);
            bool has_result = false, has_type = false;
            spv::HasResultAndType(i.op, &has_result, &has_type);
            if (has_result) definitions_[i[has_type ? 2 : 1]] = &i;
        }
    }

    std::string name(Id id) const {
        const auto found = names_.find(id);
        return found == names_.end() ? "" : found->second;
    }
    Id named(const std::string& name) const {
        const auto found = std::ranges::find_if(names_, [&](const auto& entry) { return entry.second == name; });
        if (found == names_.end()) fail("a counted shader lacks ", name);
        return found->first;
    }
    const Instruction& definition(Id id) const { return *definitions_.at(id); }
    const Instruction& type_of(Id id) const { return definition(definition(id)[1]); }
    template <class Test>
    Id find(const Test& test) const {
        for (const auto& [id, i] : definitions_)
            if (test(*i)) return id;
        fail("a counted shader lacks one of its types");
    }

    /// The variable behind a pointer, a loaded image, or a part of either; none behind a parameter of a function.
    std::optional<Id> variable(Id id) const {
        for (;;) {
            const Instruction& i = definition(id);
            switch (i.op) {
                case spv::OpVariable:
                    return id;
                case spv::OpAccessChain:
                case spv::OpInBoundsAccessChain:
                case spv::OpCopyObject:
                case spv::OpImageTexelPointer:
                case spv::OpLoad:
                case spv::OpImage:
                case spv::OpSampledImage:
                    id = i[3];
                    break;
                default:
                    return {};
            }
        }
    }

    spv::StorageClass storage_of(Id pointer) const { return spv::StorageClass(type_of(pointer)[2]); }

    /// What the shader calls an image's variable or a buffer's block.
    std::string resource(Id id) const {
        const std::optional<Id> found = variable(id);
        if (!found) fail("an image argument of a counted shader cannot be identified");
        const bool is_buffer = storage_of(*found) == spv::StorageClassStorageBuffer;
        return name(is_buffer ? type_of(*found)[3] : *found);
    }

    unsigned components(Id type) const {
        const Instruction& t = definition(type);
        return t.op == spv::OpTypeVector ? t[3] : t.op == spv::OpTypeMatrix ? t[3] * components(t[2]) : 1;
    }

    /// Bytes of a value; those of padding are none.
    unsigned size(Id type) const {
        const Instruction& t = definition(type);
        unsigned sum = 0;
        switch (t.op) {
            case spv::OpTypeInt:
            case spv::OpTypeFloat:
                return t[2] / 8;
            case spv::OpTypeVector:
            case spv::OpTypeMatrix:
                return t[3] * size(t[2]);
            case spv::OpTypeArray:
                return definition(t[3])[3] * size(t[2]);
            case spv::OpTypeStruct:
                for (size_t i = 2; i < t.words.size(); ++i) sum += size(t[i]);
                return sum;
            default:
                fail("a counted shader keeps a value of unknown size in a buffer");
        }
    }

    /// Scalar operations of an instruction.
    unsigned operations(const Instruction& i) const {
        const auto type = [&](size_t operand) { return definition(i[operand])[1]; };
        const auto product = [](unsigned results, unsigned terms) { return results * (2 * terms - 1); };
        switch (i.op) {
            case spv::OpDot:
                return product(1, components(type(3)));
            case spv::OpVectorTimesMatrix:
                return product(components(i[1]), components(type(3)));
            case spv::OpMatrixTimesVector:
                return product(components(i[1]), components(type(4)));
            case spv::OpMatrixTimesMatrix:
                return product(components(i[1]), definition(type(3))[3]);
            case spv::OpAny:
            case spv::OpAll:
                return components(type(3)) - 1;
            default:
                break;
        }
        const bool is_arithmetic = (i.op >= spv::OpConvertFToU && i.op <= spv::OpBitcast) ||
                                   (i.op >= spv::OpSNegate && i.op <= spv::OpSMulExtended) ||
                                   (i.op >= spv::OpIsNan && i.op <= spv::OpFUnordGreaterThanEqual) ||
                                   (i.op >= spv::OpShiftRightLogical && i.op <= spv::OpBitCount) ||
                                   i.op == spv::OpExtInst;
        return is_arithmetic ? components(i[1]) : 0;
    }

private:
    std::map<Id, std::string> names_;
    std::map<Id, const Instruction*> definitions_;
};

bool is_sample(spv::Op op) {
    return (op >= spv::OpImageSampleImplicitLod && op <= spv::OpImageSampleProjDrefExplicitLod);
}
bool is_gather(spv::Op op) { return op == spv::OpImageGather || op == spv::OpImageDrefGather; }
bool is_atomic(spv::Op op) { return op >= spv::OpAtomicLoad && op <= spv::OpAtomicXor; }
bool ends_block(spv::Op op) {
    return op == spv::OpSelectionMerge || op == spv::OpLoopMerge || (op >= spv::OpBranch && op <= spv::OpUnreachable);
}

/// Lets each function count. Numbers are known for each run of instructions without branches, and added at its end.
class Counting {
public:
    Counting(const Module& module, unsigned bound)
        : module_(module),
          bound_(bound),
          uint_(module.find([](const Instruction& i) { return i.op == spv::OpTypeInt && i[2] == 32 && i[3] == 0; })),
          counters_(module.named("shader_counter")),
          add_up_(module.named("shader_counters_add_up(")) {
        pointer_ = module.find([&](const Instruction& i) {
            return i.op == spv::OpTypePointer && i[2] == spv::StorageClassPrivate && i[3] == uint_;
        });
        for (const What what : shader_wide) result.push_back({what, ""});
    }

    std::vector<Instruction> counted(const std::vector<Instruction>& instructions) {
        std::vector<Instruction> before, functions;
        bool is_inside = false, is_counted = false;
        for (const Instruction& i : instructions) {
            if (i.op == spv::OpFunction) is_inside = true, is_counted = !is_own(module_.name(i[2]));
            std::vector<Instruction>& list = is_inside ? functions : before;
            if (is_counted) count(i, list);
            list.push_back(i);
        }
        leave_out_unused_sums(functions);
        for (const auto& [value, id] : constants_) before.push_back(instruction(spv::OpConstant, {uint_, id, value}));
        before.insert(before.end(), functions.begin(), functions.end());
        return before;
    }

    unsigned bound() const { return bound_; }
    std::vector<ShaderCounter> result;

private:
    /// Functions of the prelude that counts, and main, which calls what the shader has as such.
    static bool is_own(const std::string& name) { return name.starts_with("shader_counter") || name == "main"; }

    /// The prelude adds all counters that there can be, in their order: each takes the driver time to compile.
    void leave_out_unused_sums(std::vector<Instruction>& functions) const {
        const auto is_start = [&](const Instruction& i) { return i.op == spv::OpFunction && i[2] == add_up_; };
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

    void count(const Instruction& i, std::vector<Instruction>& list) {
        if (i.op == spv::OpImageFetch || i.op == spv::OpImageRead)
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
            list.push_back(instruction(spv::OpFunctionCall, {module_.definition(add_up_)[1], bound_++, add_up_}));
    }

    void count_atomic(const Instruction& i) {
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

    void add_pending(std::vector<Instruction>& list) {
        for (const auto& [place, number] : pending_) {
            const Id pointer = bound_++, before = bound_++, after = bound_++;
            list.push_back(instruction(spv::OpAccessChain, {pointer_, pointer, counters_, constant(place)}));
            list.push_back(instruction(spv::OpLoad, {uint_, before, pointer}));
            list.push_back(instruction(spv::OpIAdd, {uint_, after, before, constant(number)}));
            list.push_back(instruction(spv::OpStore, {pointer, after}));
        }
        pending_.clear();
    }

    const Module& module_;
    Id bound_;
    Id uint_, counters_, add_up_, pointer_ = 0;
    std::map<unsigned, Id> constants_;      ///< by value
    std::map<unsigned, unsigned> pending_;  ///< by the counter's place
};

/// Images that are arguments of functions are identified only after inlining.
void inline_functions_of_images(std::vector<unsigned>& spirv, const std::vector<Instruction>& instructions) {
    const Module module(instructions);
    const auto is_image = [&](const Instruction& i) {
        return i.op == spv::OpFunctionParameter && module.definition(i[1]).op == spv::OpTypePointer &&
               module.definition(i[1])[2] == spv::StorageClassUniformConstant;
    };
    if (std::ranges::none_of(instructions, is_image)) return;
    spvtools::Optimizer optimizer(SPV_ENV_VULKAN_1_2);
    optimizer.RegisterPass(spvtools::CreateMergeReturnPass()).RegisterPass(spvtools::CreateInlineOpaquePass());
    optimizer.RegisterPass(spvtools::CreateEliminateDeadFunctionsPass());
    if (!optimizer.Run(spirv.data(), spirv.size(), &spirv)) fail("a shader to be counted cannot be simplified");
}

/// Whether the module is a fragment shader whose tests can come first.
bool is_tested_early(const std::vector<Instruction>& instructions) {
    bool is_fragment = false, has_own_depth = false, discards = false;
    for (const Instruction& i : instructions) {
        is_fragment |= i.op == spv::OpEntryPoint && i[1] == spv::ExecutionModelFragment;
        has_own_depth |= i.op == spv::OpExecutionMode && i[2] == spv::ExecutionModeDepthReplacing;
        discards |= i.op == spv::OpKill;
    }
    return is_fragment && !has_own_depth && !discards;
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
    inline_functions_of_images(spirv, instructions_of(spirv));
    const std::vector<Instruction> instructions = instructions_of(spirv);
    const Module module(instructions);
    Counting counting(module, spirv[bound_word]);
    const std::vector<Instruction> counted = counting.counted(instructions);
    if (counting.result.size() > most_shader_counters)
        fail("a counted shader has ", counting.result.size(), " numbers to count, and ", most_shader_counters,
             " at most");
    const bool is_early = is_tested_early(instructions);
    spirv.resize(header_words);
    spirv[bound_word] = counting.bound();
    for (const Instruction& i : counted) {
        spirv.insert(spirv.end(), i.words.begin(), i.words.end());
        if (i.op == spv::OpEntryPoint && is_early) {
            const Instruction mode = instruction(spv::OpExecutionMode, {i[2], spv::ExecutionModeEarlyFragmentTests});
            spirv.insert(spirv.end(), mode.words.begin(), mode.words.end());
        }
    }
    return counting.result;
}
