#include "experiments/bridges/shader_export/described_shader.h"

#include "core/files.h"
#include "core/own_files.h"
#include "experiments/bridges/shader_export/declared_comment.h"
#include "experiments/bridges/shader_export/described_resources.h"

#include <algorithm>
#include <cstring>

using nlohmann::json;

namespace {

/// Of a member of `block` that is no parameter: the comment at its declaration, else at the block's.
std::string meaning_of(const std::string& glsl, const std::string& block, const std::string& member) {
    static const std::string rays = read_text(own_files() / "variants/denoisers/denoiser.h");
    const std::string last = member.substr(member.rfind('.') + 1), name = last.substr(0, last.find('['));
    for (const auto& [source, declared] : {std::pair(glsl, name), std::pair(glsl, block), std::pair(rays, block)})
        if (const std::string comment = declared_comment(source, declared); !comment.empty()) return comment;
    return "";
}

json described_member(const FrameCommand& command, const std::string& glsl, const std::string& block,
                      const BlockMember& member) {
    json described = {
        {"name", member.name}, {"type", member.type}, {"offset", member.offset}, {"is_read", member.is_read}};
    if (member.stride > 0) described["stride"] = member.stride;
    const auto parameter =
        std::ranges::find_if(command.params, [&](const Parameter& p) { return p.glsl_name() == member.name; });
    if (block == "Params" && parameter != command.params.end()) {
        described["parameter"] = parameter->name, described["value"] = parameter->value;
        described["unit"] = parameter->unit, described["meaning"] = parameter->doc;
    } else {
        described["meaning"] = meaning_of(glsl, block, member.name);
    }
    return described;
}

json number_at(const std::vector<std::byte>& bytes, const BlockMember& member) {
    const bool is_vector = member.type.find("vec") != std::string::npos;
    const int count = is_vector ? member.type.back() - '0' : 1;
    json numbers = json::array();
    for (int i = 0; i < count; ++i) {
        uint32_t word = 0;
        std::memcpy(&word, bytes.data() + member.offset + 4 * i, sizeof word);
        if (member.type.starts_with('u'))
            numbers.push_back(word);
        else if (member.type.starts_with('i'))
            numbers.push_back(std::bit_cast<int>(word));
        else
            numbers.push_back(json_number(std::bit_cast<float>(word)));
    }
    return is_vector ? numbers : numbers[0];
}

}  // namespace

json described_blocks(const FrameCommand& command, const ShaderLayout& layout, const std::string& glsl) {
    json blocks = json::array();
    for (const auto& [name, block] : layout.resources) {
        const std::optional<unsigned> binding = binding_of(command, name);
        if (block.members.empty() || !binding) continue;
        json members = json::array();
        for (const BlockMember& member : block.members)
            members.push_back(described_member(command, glsl, name, member));
        blocks.push_back({{"name", name},
                          {"set", 0},
                          {"binding", *binding},
                          {"layout", block.type == "uniform" ? "std140" : "std430"},
                          {"changes_each_frame", name != "Params"},
                          {"members", members}});
    }
    return blocks;
}

json described_constants(const StandaloneGlsl& glsl) {
    json constants = json::array();
    for (const ExportedConstant& constant : glsl.constants) {
        json described = {
            {"name", constant.name}, {"type", constant.type}, {"id", constant.id}, {"value", constant.value}};
        if (const Parameter* p = constant.parameter)
            described["parameter"] = p->name, described["parameter_value"] = p->value, described["meaning"] = p->doc;
        constants.push_back(std::move(described));
    }
    return constants;
}

json described_push(const FrameCommand& command, const FrameCommand* earlier, const ShaderLayout& layout) {
    json values = json::array();
    for (const BlockMember& member : layout.push) {
        const json value = number_at(command.push, member);
        values.push_back({{"name", member.name},
                          {"type", member.type},
                          {"offset", member.offset},
                          {"value", value},
                          {"changes_each_frame", !earlier || number_at(earlier->push, member) != value}});
    }
    return values;
}
