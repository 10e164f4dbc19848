#include "experiments/gpu_costs/spirv/shader_layout.h"

#include "experiments/gpu_costs/spirv/shader_flow.h"
#include "experiments/gpu_costs/spirv/spirv_module.h"

#include <algorithm>

namespace {

using Id = SpirvModule::Id;

bool starts_or_is_within(const std::string& path, const std::string& other) {
    const auto is_part = [](const std::string& whole, const std::string& part) {
        return part.empty() || whole == part || whole.starts_with(part + ".") || whole.starts_with(part + "[]");
    };
    return is_part(path, other) || is_part(other, path);
}

/// Finds names, types and offsets in one module.
class LayoutReader {
public:
    explicit LayoutReader(const PipelineRecipe& recipe)
        : instructions_(spirv_instructions(recipe.spirv.back())), module_(instructions_) {
        for (const SpirvInstruction& i : instructions_) {
            if (i.op == spv::OpMemberName) member_names_[{i[1], i[2]}] = i.text(3);
            if (i.op == spv::OpMemberDecorate && i[3] == spv::DecorationOffset) offsets_[{i[1], i[2]}] = i[4];
            if (i.op == spv::OpDecorate && i[2] == spv::DecorationArrayStride) strides_[i[1]] = i[3];
        }
    }

    ShaderLayout layout() const {
        ShaderLayout layout;
        for (const SpirvInstruction& i : instructions_) {
            if (i.op != spv::OpVariable) continue;
            const Id type = module_.type_of(i[2])[3];
            const auto storage = spv::StorageClass(i[3]);
            if (storage == spv::StorageClassPushConstant) add_members(layout.push, type, "", 0, 0);
            if (storage == spv::StorageClassUniformConstant)
                layout.resources[module_.name(i[2])].type = type_name(type);
            if (storage != spv::StorageClassUniform && storage != spv::StorageClassStorageBuffer) continue;
            ShaderResourceLayout& block = layout.resources[module_.name(type)];
            block.type = storage == spv::StorageClassUniform ? "uniform" : "buffer";
            add_members(block.members, type, "", 0, 0);
        }
        return layout;
    }

    /// Marks what the module, which may be another form of the one that `layout` is of, reads and writes.
    void mark_accesses(ShaderLayout& layout) const {
        for (const SpirvInstruction& i : instructions_) {
            const bool is_stored = i.op == spv::OpStore || i.op == spv::OpAtomicStore || i.op == spv::OpImageWrite;
            if (is_stored) mark(layout, i[1], false, true);
            if (i.op == spv::OpLoad || i.op == spv::OpArrayLength || is_texel_fetch(i.op))
                mark(layout, i[3], true, false);
            if (is_atomic(i.op) && !is_stored) mark(layout, i[3], true, true);
        }
    }

private:
    std::string member_name(Id structure, unsigned member) const {
        const auto found = member_names_.find({structure, member});
        return found == member_names_.end() ? "" : found->second;
    }

    std::string type_name(Id type) const {
        const SpirvInstruction& t = module_.definition(type);
        const auto prefix = [&](Id component) {
            const SpirvInstruction& c = module_.definition(component);
            return std::string(c.op == spv::OpTypeFloat ? "" : c.op == spv::OpTypeBool ? "b" : c[3] ? "i" : "u");
        };
        switch (t.op) {
            case spv::OpTypeFloat:
                return t[2] == 16 ? "float16_t" : "float";
            case spv::OpTypeInt:
                return t[3] ? "int" : "uint";
            case spv::OpTypeVector:
                return prefix(t[2]) + "vec" + std::to_string(t[3]);
            case spv::OpTypeMatrix:
                return "mat" + std::to_string(t[3]);
            case spv::OpTypeSampledImage:
                return prefix(module_.definition(t[2])[2]) + "sampler" + dimension(module_.definition(t[2]));
            case spv::OpTypeImage:
                return prefix(t[2]) + "image" + dimension(t);
            default:
                return module_.name(type);
        }
    }

    static std::string dimension(const SpirvInstruction& image) {
        const std::string name = image[3] == spv::DimCube ? "Cube" : image[3] == spv::Dim3D ? "3D" : "2D";
        return image[5] ? name + "Array" : name;
    }

    void add_members(std::vector<BlockMember>& members, Id type, const std::string& path, unsigned offset,
                     unsigned stride) const {
        const SpirvInstruction& t = module_.definition(type);
        if (t.op == spv::OpTypeStruct) {
            for (unsigned m = 0; m + 2 < t.words.size(); ++m)
                add_members(members, t[m + 2], path + (path.empty() ? "" : ".") + member_name(type, m),
                            offset + offsets_.at({type, m}), stride);
        } else if (t.op == spv::OpTypeArray || t.op == spv::OpTypeRuntimeArray) {
            add_members(members, t[2], path + "[]", offset, strides_.at(type));
        } else {
            members.push_back({.name = path, .type = type_name(type), .offset = offset, .stride = stride});
        }
    }

    /// The name, as BlockMember has it, of what a pointer into a block leads to.
    std::string path_of(Id pointer) const {
        const SpirvInstruction& chain = module_.definition(pointer);
        if (chain.op != spv::OpAccessChain && chain.op != spv::OpInBoundsAccessChain) return "";
        std::string path = path_of(chain[3]);
        Id type = module_.type_of(chain[3])[3];
        for (size_t word = 4; word < chain.words.size(); ++word) {
            const SpirvInstruction& t = module_.definition(type);
            if (t.op == spv::OpTypeStruct) {
                const unsigned member = module_.definition(chain[word])[3];
                path += (path.empty() ? "" : ".") + member_name(type, member);
                type = t[member + 2];
            } else if (t.op == spv::OpTypeArray || t.op == spv::OpTypeRuntimeArray) {
                path += "[]";
                type = t[2];
            } else {
                break;  // a component of a vector or matrix
            }
        }
        return path;
    }

    void mark(ShaderLayout& layout, Id pointer, bool reads, bool writes) const {
        const std::optional<Id> variable = module_.variable(pointer);
        if (!variable) return;
        const auto storage = spv::StorageClass(module_.definition(*variable)[3]);
        const bool is_push = storage == spv::StorageClassPushConstant;
        const bool is_image = storage == spv::StorageClassUniformConstant;
        const bool is_block = storage == spv::StorageClassUniform || storage == spv::StorageClassStorageBuffer;
        if (!is_push && !is_image && !is_block) return;
        if (!is_push) {
            const Id type = module_.type_of(*variable)[3];
            ShaderResourceLayout& resource = layout.resources.at(module_.name(is_image ? *variable : type));
            // Loading a storage image only precedes its use.
            const bool is_handle = is_image && resource.type.find("image") != std::string::npos &&
                                   module_.definition(pointer).op == spv::OpVariable;
            resource.is_read |= reads && !is_handle, resource.is_written |= writes;
            if (is_image) return;
        }
        std::vector<BlockMember>& members =
            is_push ? layout.push : layout.resources.at(module_.name(module_.type_of(*variable)[3])).members;
        for (BlockMember& member : members)
            member.is_read |= reads && starts_or_is_within(member.name, path_of(pointer));
    }

    std::vector<SpirvInstruction> instructions_;
    SpirvModule module_;
    std::map<std::pair<Id, unsigned>, std::string> member_names_;
    std::map<std::pair<Id, unsigned>, unsigned> offsets_;
    std::map<Id, unsigned> strides_;
};

}  // namespace

ShaderLayout layout_of(const PipelineRecipe& recipe) {
    ShaderLayout layout = LayoutReader(recipe).layout();
    LayoutReader(simplified(recipe)).mark_accesses(layout);
    return layout;
}
