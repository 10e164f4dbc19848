#include "experiments/gpu_costs/spirv/spirv_module.h"

#include <algorithm>

std::string SpirvInstruction::text(size_t from) const {
    std::string text;
    for (size_t i = from; i < words.size(); ++i)
        for (int byte = 0; byte < 4; ++byte) {
            const char c = char(words[i] >> (8 * byte) & 255);
            if (!c) return text;
            text += c;
        }
    return text;
}

SpirvInstruction spirv_instruction(spv::Op op, std::vector<unsigned> operands) {
    operands.insert(operands.begin(), unsigned(operands.size() + 1) << 16 | unsigned(op));
    return {op, std::move(operands)};
}

std::vector<SpirvInstruction> spirv_instructions(const std::vector<unsigned>& spirv) {
    std::vector<SpirvInstruction> list;
    for (size_t at = spirv_header_words; at < spirv.size(); at += spirv[at] >> 16)
        list.push_back(
            {spv::Op(spirv[at] & 0xffff), {spirv.begin() + long(at), spirv.begin() + long(at + (spirv[at] >> 16))}});
    return list;
}

SpirvModule::SpirvModule(const std::vector<SpirvInstruction>& instructions) {
    for (const SpirvInstruction& i : instructions) {
        if (i.op == spv::OpName) names_[i[1]] = i.text(2);
        bool has_result = false, has_type = false;
        spv::HasResultAndType(i.op, &has_result, &has_type);
        if (has_result) definitions_[i[has_type ? 2 : 1]] = &i;
    }
}

std::string SpirvModule::name(Id id) const {
    const auto found = names_.find(id);
    return found == names_.end() ? "" : found->second;
}

SpirvModule::Id SpirvModule::named(const std::string& name) const {
    const auto found = std::ranges::find_if(names_, [&](const auto& entry) { return entry.second == name; });
    if (found == names_.end()) fail("a shader lacks ", name);
    return found->first;
}

std::optional<SpirvModule::Id> SpirvModule::variable(Id id) const {
    for (;;) {
        const SpirvInstruction& i = definition(id);
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

std::string SpirvModule::resource(Id id) const {
    const std::optional<Id> found = variable(id);
    if (!found) fail("an image argument of a counted shader cannot be identified");
    const bool is_buffer = storage_of(*found) == spv::StorageClassStorageBuffer;
    return name(is_buffer ? type_of(*found)[3] : *found);
}

unsigned SpirvModule::components(Id type) const {
    const SpirvInstruction& t = definition(type);
    return t.op == spv::OpTypeVector ? t[3] : t.op == spv::OpTypeMatrix ? t[3] * components(t[2]) : 1;
}

unsigned SpirvModule::size(Id type) const {
    const SpirvInstruction& t = definition(type);
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

unsigned SpirvModule::operations(const SpirvInstruction& i) const {
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
                               (i.op >= spv::OpShiftRightLogical && i.op <= spv::OpBitCount) || i.op == spv::OpExtInst;
    return is_arithmetic ? components(i[1]) : 0;
}

bool is_sample(spv::Op op) {
    return op >= spv::OpImageSampleImplicitLod && op <= spv::OpImageSampleProjDrefExplicitLod;
}
bool is_gather(spv::Op op) { return op == spv::OpImageGather || op == spv::OpImageDrefGather; }
bool is_texel_fetch(spv::Op op) { return op == spv::OpImageFetch || op == spv::OpImageRead; }
bool is_atomic(spv::Op op) { return op >= spv::OpAtomicLoad && op <= spv::OpAtomicXor; }

bool is_tested_early(const std::vector<SpirvInstruction>& instructions) {
    bool is_fragment = false, has_own_depth = false, discards = false;
    for (const SpirvInstruction& i : instructions) {
        is_fragment |= i.op == spv::OpEntryPoint && i[1] == spv::ExecutionModelFragment;
        has_own_depth |= i.op == spv::OpExecutionMode && i[2] == spv::ExecutionModeDepthReplacing;
        discards |= i.op == spv::OpKill;
    }
    return is_fragment && !has_own_depth && !discards;
}
