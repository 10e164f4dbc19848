#include "experiments/gpu_costs/spirv/spirv_text.h"

#include "core/error.h"
#include "core/list_text.h"
#include "experiments/gpu_costs/spirv/spirv_module.h"

#include <algorithm>
#include <spirv-tools/libspirv.hpp>
#include <sstream>

namespace {

constexpr spv_target_env environment = SPV_ENV_VULKAN_1_2;

std::vector<std::string> words_of(const std::string& line) {
    std::istringstream in(line);
    std::vector<std::string> words;
    for (std::string word; in >> word;) words.push_back(word);
    return words;
}

/// The opcode of a line: "%1 = OpLabel", or "OpReturn".
const std::string& opcode(const std::vector<std::string>& words) {
    return words.size() > 2 && words[1] == "=" ? words[2] : words[0];
}

bool ends_block(const std::string& op) {
    static const std::vector<std::string> all = {
        "OpBranch", "OpBranchConditional", "OpSwitch",      "OpReturn",
        "OpKill",   "OpUnreachable",       "OpReturnValue", "OpTerminateInvocation"};
    return std::ranges::count(all, op) > 0;
}

/// Where lines stand in a module: what comes before decorations, these, declarations, the function.
bool is_decoration(const std::string& op) { return op.starts_with("OpDecorate") || op.starts_with("OpMemberDecorate"); }
bool is_header(const std::string& op) {
    return op == "OpCapability" || op == "OpExtension" || op == "OpExtInstImport" || op == "OpMemoryModel" ||
           op == "OpEntryPoint" || op.starts_with("OpExecutionMode");
}
bool is_name(const std::string& op) {
    return op.starts_with("OpSource") || op == "OpName" || op == "OpMemberName" || op == "OpString" ||
           op == "OpModuleProcessed" || op == "OpLine" || op == "OpNoLine";
}

}  // namespace

SpirvText::SpirvText(const std::vector<unsigned>& spirv) {
    const spvtools::SpirvTools tools(environment);
    std::string text;
    if (!tools.Disassemble(spirv, &text, SPV_BINARY_TO_TEXT_OPTION_NO_HEADER)) fail("a shader is not valid SPIR-V");
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);) {
        const Words words = words_of(line);
        if (words.empty()) continue;
        const std::string& op = opcode(words);
        if (is_name(op)) continue;
        if (op == "OpFunction" || !function_.empty())
            function_.push_back(words);
        else if (is_header(op))
            header_.push_back(words);
        else if (is_decoration(op))
            decorations_.push_back(words);
        else
            declarations_.push_back(words),
                results_[joined({words.begin() + std::min<size_t>(2, words.size()), words.end()}, " ")] = words[0];
    }
}

void SpirvText::declare(const std::string& name, const std::string& definition) {
    Words words = words_of(definition);
    for (std::string& word : words)
        if (const auto known = names_.find(word); known != names_.end()) word = known->second;
    const auto [entry, is_new] = results_.try_emplace(joined(words, " "), "%" + name);
    names_["%" + name] = entry->second;
    if (!is_new) return;
    words.insert(words.begin(), {"%" + name, "="});
    declarations_.push_back(words);
}

void SpirvText::declare_storage_buffer(const std::string& name, const std::string& pointer,
                                       const std::string& uint_type, unsigned binding) {
    const std::string array = "%" + name + "_array", block = "%" + name + "_block", whole = "%" + name + "_whole";
    for (const std::string& line : {array + " ArrayStride 4", block + " Block", "%" + name + " DescriptorSet 0",
                                    "%" + name + " Binding " + std::to_string(binding)})
        decorations_.push_back(words_of("OpDecorate " + line));
    decorations_.push_back(words_of("OpMemberDecorate " + block + " 0 Offset 0"));
    declarations_.push_back(words_of(array + " = OpTypeRuntimeArray " + uint_type));
    declarations_.push_back(words_of(block + " = OpTypeStruct " + array));
    declarations_.push_back(words_of(whole + " = OpTypePointer StorageBuffer " + block));
    declare(pointer, "OpTypePointer StorageBuffer " + uint_type);
    declare_variable(name, "OpVariable " + whole + " StorageBuffer");
}

void SpirvText::declare_variable(const std::string& name, const std::string& definition) {
    declarations_.push_back(words_of("%" + name + " = " + definition));
    add_to_interface("%" + name);
}

void SpirvText::add_to_interface(const std::string& variable) {
    for (Words& words : header_)
        if (words[0] == "OpEntryPoint") words.push_back(variable);
}

std::string SpirvText::built_in(const std::string& what, const std::string& type) {
    for (const Words& words : decorations_)
        if (words.size() == 4 && words[2] == "BuiltIn" && words[3] == what) return words[1];
    const std::string name = "wave_" + what;
    decorations_.push_back({"OpDecorate", "%" + name, "BuiltIn", what});
    declare(name + "_pointer", "OpTypePointer Input " + type);
    declare_variable(name, "OpVariable %" + name + "_pointer Input");
    return "%" + name;
}

void SpirvText::add_functions(const std::string& lines) { added_functions_ += lines; }

std::string SpirvText::add_copy() {
    std::map<std::string, std::string> copies;
    for (const Words& words : function_)
        if (words.size() > 2 && words[1] == "=") copies[words[0]] = "%copy_of_" + words[0].substr(1);
    for (const Words& words : std::vector<Words>(decorations_))
        if (const auto copy = copies.find(words[1]); copy != copies.end()) {
            decorations_.push_back(words);
            decorations_.back()[1] = copy->second;
        }
    for (const Words& words : function_) {
        for (const std::string& word : words) {
            const auto copy = copies.find(word);
            added_functions_ += (copy == copies.end() ? word : copy->second) + ' ';
        }
        added_functions_ += '\n';
    }
    return copies.at(function_.front()[0]);
}

std::string SpirvText::replace_entry_point(const std::string& name) {
    const std::string former = function_.front()[0];
    for (Words& words : header_)
        if (words[0] == "OpEntryPoint" || words[0].starts_with("OpExecutionMode"))
            std::ranges::replace(words, former, "%" + name);
    return former;
}

void SpirvText::test_early_where_possible() {
    if (!is_tested_early(spirv_instructions(assembled()))) return;
    for (size_t i = 0; i < header_.size(); ++i)
        if (header_[i][0] == "OpEntryPoint") {
            header_.insert(header_.begin() + long(i) + 1, {"OpExecutionMode", header_[i][2], "EarlyFragmentTests"});
            return;
        }
}

void SpirvText::edit_blocks(const std::function<void(Block&)>& edit) {
    std::vector<Words> edited;
    for (size_t i = 0; i < function_.size();) {
        if (opcode(function_[i]) != "OpLabel") {
            edited.push_back(function_[i++]);
            continue;
        }
        Block block;
        block.label = unsigned(std::stoul(function_[i][0].substr(1)));
        size_t end = i + 1;
        while (!ends_block(opcode(function_[end]))) ++end;
        block.terminator = function_[end];
        edit(block);
        edited.push_back(function_[i++]);
        while (opcode(function_[i]) == "OpVariable" || opcode(function_[i]) == "OpPhi")
            edited.push_back(function_[i++]);
        for (const std::string& line : block.at_start) edited.push_back(words_of(line));
        size_t branch = end;
        if (opcode(function_[branch - 1]) == "OpSelectionMerge" || opcode(function_[branch - 1]) == "OpLoopMerge")
            --branch;
        while (i < branch) edited.push_back(function_[i++]);
        for (const std::string& line : block.at_end) edited.push_back(words_of(line));
        while (i <= end) edited.push_back(function_[i++]);
    }
    function_ = std::move(edited);
}

std::string SpirvText::type_of(const std::string& id) const {
    for (const std::vector<Words>* part : {&function_, &declarations_})
        for (const Words& words : *part)
            if (words[0] == id && words.size() > 3) return words[3];
    fail("a shader lacks ", id);
}

std::vector<unsigned> SpirvText::assembled() const {
    std::string text;
    const auto add = [&](const Words& words) {
        for (const std::string& word : words) {
            const auto known = names_.find(word);
            text += (known == names_.end() ? word : known->second) + ' ';
        }
        text += '\n';
    };
    for (const std::vector<Words>* part : {&header_, &decorations_, &declarations_, &function_})
        for (const Words& words : *part) add(words);
    std::istringstream added(added_functions_);
    for (std::string line; std::getline(added, line);) add(words_of(line));

    spvtools::SpirvTools tools(environment);
    std::string message;
    tools.SetMessageConsumer([&](spv_message_level_t, const char*, const spv_position_t& at, const char* what) {
        message = "line " + std::to_string(at.line + 1) + ": " + what;
    });
    std::vector<unsigned> spirv;
    if (!tools.Assemble(text, &spirv, SPV_TEXT_TO_BINARY_OPTION_PRESERVE_NUMERIC_IDS))
        fail("a shader that was changed is no SPIR-V: ", message);
    return spirv;
}
