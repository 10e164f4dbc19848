#include "experiments/gpu_costs/spirv/zero_products.h"

#include "core/error.h"
#include "experiments/gpu_costs/spirv/shader_flow.h"
#include "experiments/gpu_costs/spirv/spirv_module.h"

#include <SPIRV/GLSL.std.450.h>
#include <algorithm>
#include <map>
#include <spirv-tools/optimizer.hpp>

namespace {

/// simplified(), with values in place of local variables.
std::vector<unsigned> with_values(const PipelineRecipe& recipe) {
    std::vector<unsigned> spirv = simplified(recipe).spirv.back();
    spvtools::Optimizer optimizer(SPV_ENV_VULKAN_1_2);
    optimizer.RegisterPass(spvtools::CreatePrivateToLocalPass())
        .RegisterPass(spvtools::CreateScalarReplacementPass(0))
        .RegisterPass(spvtools::CreateLocalAccessChainConvertPass())
        .RegisterPass(spvtools::CreateSSARewritePass())
        .RegisterPass(spvtools::CreateCCPPass())
        .RegisterPass(spvtools::CreateDeadBranchElimPass())
        .RegisterPass(spvtools::CreateAggressiveDCEPass());
    if (!optimizer.Run(spirv.data(), spirv.size(), &spirv)) fail("the products of a shader cannot be counted");
    return spirv;
}

/// What is known of one component of a value. Uniforms and what integers become are finite, too.
enum class Known { nothing, finite, zero, one };

class ZeroProducts {
public:
    explicit ZeroProducts(const std::vector<unsigned>& spirv)
        : instructions_(spirv_instructions(spirv)), module_(instructions_) {}

    unsigned count() {
        unsigned sum = 0;
        for (const SpirvInstruction& i : instructions_) sum += in(i);
        return sum;
    }

private:
    using Components = std::vector<Known>;

    /// Of a scalar, a vector, or a matrix column by column. Values are made of others many times over.
    const Components& of(unsigned id) {
        if (const auto found = known_.find(id); found != known_.end()) return found->second;
        Components components = derived(id);
        return known_[id] = std::move(components);
    }
    Components derived(unsigned id) {
        const SpirvInstruction& i = module_.definition(id);
        const SpirvInstruction& type = module_.type_of(id);
        switch (i.op) {
            case spv::OpConstant:
                if (type.op != spv::OpTypeFloat || type[2] != 32) break;
                return {(i[3] & 0x7fffffff) == 0 ? Known::zero : i[3] == 0x3f800000 ? Known::one : Known::finite};
            case spv::OpConstantNull:
                return Components(module_.components(type[1]), Known::zero);
            case spv::OpConstantComposite:
            case spv::OpCompositeConstruct: {
                Components all;
                for (size_t part = 3; part < i.words.size(); ++part)
                    std::ranges::copy(of(i[part]), std::back_inserter(all));
                return all;
            }
            case spv::OpVectorShuffle: {
                Components from = of(i[3]), all;
                std::ranges::copy(of(i[4]), std::back_inserter(from));
                for (size_t part = 5; part < i.words.size(); ++part)
                    all.push_back(i[part] < from.size() ? from[i[part]] : Known::nothing);
                return all;
            }
            case spv::OpCompositeExtract: {
                // A part of a vector, or a column or a component of a matrix; structures and arrays are not followed.
                const Components from = of(i[3]);
                const spv::Op whole = module_.type_of(i[3]).op;
                if (whole != spv::OpTypeVector && whole != spv::OpTypeMatrix) return unknown(type);
                if (from.size() != module_.components(module_.type_of(i[3])[1])) return unknown(type);
                const size_t parts = unknown(type).size(),
                             rows = i.words.size() > 5 ? module_.components(module_.type_of(i[3])[2]) : parts;
                const size_t first = i[4] * rows + (i.words.size() > 5 ? i[5] : 0);
                return {from.begin() + std::ptrdiff_t(first), from.begin() + std::ptrdiff_t(first + parts)};
            }
            case spv::OpLoad: {
                const spv::StorageClass storage = module_.storage_of(i[3]);
                const bool is_uniform = storage == spv::StorageClassUniform || storage == spv::StorageClassPushConstant;
                return is_uniform ? Components(unknown(type).size(), Known::finite) : unknown(type);
            }
            case spv::OpConvertSToF:
            case spv::OpConvertUToF:
                return Components(unknown(type).size(), Known::finite);
            case spv::OpFNegate:
            case spv::OpCopyObject:
                return of(i[3]);
            default:
                break;
        }
        return unknown(type);
    }
    Components unknown(const SpirvInstruction& type) const {
        const bool is_numbers = type.op == spv::OpTypeFloat || type.op == spv::OpTypeInt ||
                                type.op == spv::OpTypeVector || type.op == spv::OpTypeMatrix;
        return Components(is_numbers ? module_.components(type[1]) : 1, Known::nothing);
    }

    /// Of products of the components with each other; one component serves all of the other value.
    static unsigned products(const Components& a, const Components& b) {
        unsigned sum = 0;
        for (size_t c = 0; c < std::max(a.size(), b.size()); ++c) {
            const Known x = a[a.size() == 1 ? 0 : c], y = b[b.size() == 1 ? 0 : c];
            sum += (x == Known::zero && y == Known::nothing) || (x == Known::nothing && y == Known::zero);
        }
        return sum;
    }
    /// Of products of matrices: each 0 among `all` takes part in `times` with components of `other`.
    static unsigned parts(const Components& all, const Components& other, size_t times) {
        const bool is_hidden = std::ranges::find(other, Known::nothing) != other.end();
        return is_hidden ? unsigned(size_t(std::ranges::count(all, Known::zero)) * times) : 0;
    }

    unsigned in(const SpirvInstruction& i) {
        switch (i.op) {
            case spv::OpFMul:
            case spv::OpDot:
            case spv::OpVectorTimesScalar:
            case spv::OpMatrixTimesScalar:
                return products(of(i[3]), of(i[4]));
            case spv::OpFDiv: {
                const Components whole = of(i[3]), by = of(i[4]);
                unsigned sum = 0;
                for (size_t c = 0; c < whole.size(); ++c) sum += whole[c] == Known::zero && by[c] == Known::nothing;
                return sum;
            }
            case spv::OpMatrixTimesVector:
            case spv::OpVectorTimesMatrix:
            case spv::OpMatrixTimesMatrix: {
                const Components a = of(i[3]), b = of(i[4]);
                const SpirvInstruction& type = module_.definition(i[1]);
                const unsigned columns = i.op == spv::OpMatrixTimesMatrix   ? type[3]
                                         : i.op == spv::OpVectorTimesMatrix ? module_.components(i[1])
                                                                            : 1;
                const unsigned rows = i.op == spv::OpVectorTimesMatrix ? 1 : module_.components(i[1]) / columns;
                return parts(a, b, columns) + parts(b, a, rows);
            }
            case spv::OpExtInst:
                return in_function(i);
            default:
                return 0;
        }
    }

    unsigned in_function(const SpirvInstruction& i) {
        if (!module_.definition(i[3]).text(2).starts_with("GLSL.std.450")) return 0;
        switch (i[4]) {
            case GLSLstd450FMix: {
                const Components from = of(i[5]), to = of(i[6]), weight = of(i[7]);
                Components rest = weight;
                for (Known& w : rest) w = w == Known::one ? Known::zero : w == Known::zero ? Known::one : w;
                return products(from, rest) + products(to, weight);
            }
            case GLSLstd450Fma:
            case GLSLstd450Pow:
            case GLSLstd450Reflect:
                return products(of(i[5]), of(i[6]));
            case GLSLstd450Cross: {  // of two components of a vector each with one of the other vector's
                const Components a = of(i[5]), b = of(i[6]);
                unsigned sum = 0;
                for (size_t c = 0; c < 3; ++c)
                    for (const size_t other : {(c + 1) % 3, (c + 2) % 3}) sum += products({a[c]}, {b[other]});
                return sum;
            }
            default:
                return 0;
        }
    }

    std::vector<SpirvInstruction> instructions_;
    SpirvModule module_;
    std::map<unsigned, Components> known_;  ///< by id; entries keep their addresses
};

}  // namespace

unsigned zero_products(const PipelineRecipe& recipe) { return ZeroProducts(with_values(recipe)).count(); }
