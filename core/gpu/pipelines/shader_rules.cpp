#include "core/gpu/pipelines/shader_rules.h"

#include <SPIRV/doc.h>
#include <SPIRV/spirv.hpp>
#include <algorithm>
#include <array>

namespace {

/// What needed_features() and Vulkan 1.3 have; Float16 and Float64 where the device has them. Subgroups: all that one
/// operation needs, since a device says which it has.
constexpr std::array allowed = {
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

std::vector<std::string> foreign_capabilities(const std::vector<unsigned>& spirv) {
    std::vector<std::string> found;
    constexpr size_t header = 5;
    for (size_t i = header; i < spirv.size(); i += std::max(1u, spirv[i] >> spv::WordCountShift)) {
        const auto op = spv::Op(spirv[i] & spv::OpCodeMask);
        if (op == spv::OpCapability && std::ranges::find(allowed, spv::Capability(spirv[i + 1])) == allowed.end())
            found.push_back(spv::CapabilityString(int(spirv[i + 1])));
        if (op == spv::OpExtension) found.push_back(reinterpret_cast<const char*>(&spirv[i + 1]));
        if (op == spv::OpMemoryModel) break;  // both stand before it
    }
    return found;
}
