#pragma once
#include "core/error.h"

#include <map>
#include <optional>
#include <string>
#include <vector>

#define SPV_ENABLE_UTILITY_CODE
#include <SPIRV/spirv.hpp>

// SPIR-V as a list of instructions, for code that changes it: gpu_costs only.

struct SpirvInstruction {
    spv::Op op;
    std::vector<unsigned> words;  ///< the first holds length and opcode

    unsigned operator[](size_t i) const { return words[i]; }
    std::string text(size_t from) const;  ///< the literal that begins at this word
};

/// Makes an instruction from an opcode and its operands.
SpirvInstruction spirv_instruction(spv::Op op, std::vector<unsigned> operands);

inline constexpr size_t spirv_header_words = 5, spirv_bound_word = 3;

std::vector<SpirvInstruction> spirv_instructions(const std::vector<unsigned>& spirv);

/// The meaning of a module's ids. `instructions` must outlive it.
class SpirvModule {
public:
    using Id = unsigned;

    explicit SpirvModule(const std::vector<SpirvInstruction>& instructions);

    std::string name(Id id) const;
    Id named(const std::string& name) const;  ///< fails with Error if there is none
    const SpirvInstruction& definition(Id id) const { return *definitions_.at(id); }
    const SpirvInstruction& type_of(Id id) const { return definition(definition(id)[1]); }
    /// Fails with Error if there is none.
    template <class Test>
    Id find(const Test& test) const {
        for (const auto& [id, i] : definitions_)
            if (test(*i)) return id;
        fail("a shader lacks one of its types");
    }

    /// The variable behind a pointer, a loaded image, or a part of either; nullopt behind a function's parameter.
    std::optional<Id> variable(Id id) const;
    spv::StorageClass storage_of(Id pointer) const { return spv::StorageClass(type_of(pointer)[2]); }
    /// The shader's name of an image's variable or a buffer's block. Fails with Error if unknown.
    std::string resource(Id id) const;
    unsigned components(Id type) const;
    unsigned size(Id type) const;  ///< bytes of a value, without padding
    /// Scalar operations of an instruction; see count_in() in counted_shader.h.
    unsigned operations(const SpirvInstruction& i) const;

private:
    std::map<Id, std::string> names_;
    std::map<Id, const SpirvInstruction*> definitions_;
};

/// Whether an instruction reads an image: through the sampler's filter, four texels at a time, or single texels.
bool is_sample(spv::Op op);
bool is_gather(spv::Op op);
bool is_texel_fetch(spv::Op op);
bool is_atomic(spv::Op op);

/// Whether the module is a fragment shader that can be tested for depth and stencil first: it has no discard and no
/// depth of its own.
bool is_tested_early(const std::vector<SpirvInstruction>& instructions);
