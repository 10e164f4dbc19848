#include "core/gpu/pipelines/glsl_compiler/shader_rules.h"

#include <SPIRV/doc.h>
#include <SPIRV/spirv.hpp>
#include <algorithm>
#include <cstring>
#include <iterator>

namespace {

/// What needed_features() and Vulkan 1.3 have; Float16 and Float64 where the device has them. Subgroups: all that one
/// operation needs, since a device says which it has.
constexpr unsigned allowed[] = {
    spv::CapabilityShader,
    spv::CapabilityMatrix,
    spv::CapabilityFloat16,
    spv::CapabilityFloat64,
    spv::CapabilityImageQuery,
    spv::CapabilityDerivativeControl,
    spv::CapabilityStorageImageExtendedFormats,
    spv::CapabilityStorageImageWriteWithoutFormat,
    spv::CapabilityGroupNonUniform,
    spv::CapabilityGroupNonUniformVote,
    spv::CapabilityGroupNonUniformBallot,
    spv::CapabilityGroupNonUniformArithmetic,
    spv::CapabilityGroupNonUniformShuffle,
    spv::CapabilityGroupNonUniformShuffleRelative,
    spv::CapabilityGroupNonUniformClustered,
    spv::CapabilityGroupNonUniformQuad,
};

}  // namespace

std::vector<std::string> foreign_capabilities(std::span<const unsigned> spirv) {
    std::vector<std::string> found;
    constexpr size_t header = 5;
    for (std::span<const unsigned> rest = spirv.subspan(std::min(header, spirv.size())); !rest.empty();) {
        const size_t words = rest[0] >> spv::WordCountShift;
        const auto op = spv::Op(rest[0] & spv::OpCodeMask);
        if (op == spv::OpMemoryModel) break;  // both stand before it
        const bool has_operand = op == spv::OpCapability || op == spv::OpExtension;
        if (words < (has_operand ? 2u : 1u) || words > rest.size()) {
            found.push_back("an instruction without its words");
            break;
        }
        if (op == spv::OpCapability && std::ranges::find(allowed, rest[1]) == std::end(allowed))
            found.push_back(spv::CapabilityString(int(rest[1])));
        if (op == spv::OpExtension) {
            const char* const name = reinterpret_cast<const char*>(&rest[1]);
            found.emplace_back(name, strnlen(name, (words - 1) * sizeof rest[0]));
        }
        rest = rest.subspan(words);
    }
    return found;
}
