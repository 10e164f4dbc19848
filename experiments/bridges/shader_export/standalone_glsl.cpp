#include "experiments/bridges/shader_export/standalone_glsl.h"

#include "core/digits.h"
#include "core/error.h"

#include <algorithm>
#include <bit>
#include <map>
#include <regex>
#include <set>
#include <sstream>

namespace {

std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);) lines.push_back(line);
    return lines;
}

std::string code_of(const std::string& line) { return line.substr(0, line.find("//")); }

/// Resolves #ifdef and #ifndef of macros that are the text's own, above all the guards of files that are included more
/// than once, and drops #line. Other conditions stay.
std::vector<std::string> without_repetition(const std::vector<std::string>& lines) {
    struct Condition {
        bool is_resolved, is_taken;  ///< a condition that stays counts as taken
    };
    static const std::regex directive(R"(^\s*#\s*(ifdef|ifndef|if|else|elif|endif|define|undef|line)\b\s*(\w*).*$)");
    std::set<std::string> defined, uncertain;  // uncertain: defined under a condition that stays
    std::vector<Condition> open;
    std::vector<std::string> kept;
    for (const std::string& line : lines) {
        const bool is_kept = std::ranges::all_of(open, &Condition::is_taken);
        std::smatch found;
        if (!std::regex_match(line, found, directive)) {
            if (is_kept) kept.push_back(line);
            continue;
        }
        const std::string what = found[1], name = found[2];
        if (what == "line") continue;
        const bool is_end = what == "endif" || what == "else" || what == "elif";
        if (is_end && open.empty()) fail("a shader has an #", what, " without its #if");
        if (is_end && open.back().is_resolved) {
            if (what == "endif") open.pop_back();
            if (what == "else") open.back().is_taken = !open.back().is_taken;
            continue;
        }
        if (what == "ifdef" || what == "ifndef") {
            const bool is_resolved = !name.starts_with("GL_") && name != "VULKAN" && !uncertain.contains(name);
            open.push_back({is_resolved, !is_resolved || defined.contains(name) == (what == "ifdef")});
            if (is_resolved) continue;
        } else if (what == "if") {
            open.push_back({false, true});
        } else if (what == "endif") {
            open.pop_back();
        }
        const bool is_certain = std::ranges::all_of(open, &Condition::is_resolved);
        if (is_kept && (what == "define" || what == "undef")) {
            if (!is_certain)
                uncertain.insert(name);
            else if (what == "define")
                defined.insert(name);
            else
                defined.erase(name);
        }
        const bool is_guard = what == "define" && (name.ends_with("_H") || name.ends_with("_GLSL"));
        if (is_kept && !is_guard) kept.push_back(line);
    }
    return kept;
}

/// How often each name stands in the code.
using NameCounts = std::map<std::string, size_t>;

NameCounts names_in(const std::vector<std::string>& lines) {
    static const std::regex word(R"([A-Za-z_]\w*)");
    NameCounts counts;
    for (const std::string& line : lines) {
        const std::string code = code_of(line);
        for (std::sregex_iterator at(code.begin(), code.end(), word), end; at != end; ++at) ++counts[at->str()];
    }
    return counts;
}

/// Whether something else than its declaration names it.
bool is_named(const NameCounts& counts, const std::string& name) { return counts.at(name) > 1; }

const std::regex& constant_line() {
    static const std::regex line(R"(^layout\(constant_id = (\d+)\) const (\w+) (\w+) = .*;$)");
    return line;
}

const Parameter* parameter_of(const ParameterSet& params, const std::string& glsl_name) {
    const auto found = std::ranges::find_if(params, [&](const Parameter& p) { return p.glsl_name() == glsl_name; });
    return found == params.end() ? nullptr : &*found;
}

/// Also of a constant that the compiled shader ignores.
uint32_t bits_of(const FrameCommand& pass, const ExportedConstant& constant) {
    if (const auto used = pass.recipe.constants.find(constant.id); used != pass.recipe.constants.end())
        return used->second;
    if (const auto set = pass.constants.find(constant.name); set != pass.constants.end()) return set->second;
    if (constant.parameter) return constant.parameter->bits();
    return std::ranges::find(scene_constants(), constant.name, &SceneConstant::name)->initial;
}

std::string note_of(const Parameter& p) {
    const std::string value = p.choices.empty() ? "" : " = " + p.value.get<std::string>();
    return "  // " + p.name + value + (p.unit.empty() ? "" : " (" + p.unit + ")") + ": " + p.doc;
}

/// Writes sets and bindings into declarations, and leaves out resources that nothing names. One that only functions
/// name which are never called keeps a binding of its own, which no descriptor set needs.
class Bindings {
public:
    Bindings(const PipelineRecipe& recipe, const NameCounts& counts) : counts_(counts) {
        for (const ShaderInterface::Resource& r : recipe.resources) {
            if (!r.is_vertex) bindings_[r.name] = r.binding;
            next_ = std::max(next_, r.binding + 1);
        }
    }

    std::string written_into(const std::string& text) {
        static const std::regex declaration(
            R"((^|\n)(?:layout\s*\(([^)]*)\)\s*)?((?:(?:uniform|buffer|readonly|writeonly|coherent|restrict|volatile)\s+)+)(\w+)(\s+[^;{]*;|\s*\{[^}]*\}[^;]*;))");
        std::string result;
        auto rest = text.begin();
        for (std::sregex_iterator at(text.begin(), text.end(), declaration), end; at != end; ++at) {
            const std::smatch& found = *at;
            const std::string declared = is_block(found[5]) ? block(found) : images(found);
            result.append(rest, found[0].first);
            if (!declared.empty()) result.append(found[1]).append(declared);
            rest = found[0].second;
        }
        return result.append(rest, text.end());
    }

private:
    static bool is_block(const std::string& end) { return end.find('{') != std::string::npos; }

    std::string block(const std::smatch& found) {
        const std::string layout = found[2], qualifiers = found[3], name = found[4], body = found[5];
        if (layout.find("push_constant") != std::string::npos)
            return "layout(" + layout + ") " + qualifiers + name + body;
        static const std::regex member(R"((\w+)(\[\w*\])*\s*[;,])");
        bool is_used = bindings_.contains(name);
        for (std::sregex_iterator at(body.begin(), body.end(), member), end; at != end; ++at)
            is_used |= counts_.contains((*at)[1]) && is_named(counts_, (*at)[1]);
        if (!is_used) return "";
        const bool is_buffer = qualifiers.find("buffer") != std::string::npos;
        return placed(layout.empty() ? is_buffer ? "std430" : "std140" : layout, name) + qualifiers + name + body;
    }

    std::string images(const std::smatch& found) {
        static const std::regex name(R"(\w+)");
        const std::string names = found[5];
        std::string lines;
        for (std::sregex_iterator at(names.begin(), names.end(), name), end; at != end; ++at)
            if (bindings_.contains(at->str()) || is_named(counts_, at->str()))
                lines += (lines.empty() ? "" : "\n") + placed(found[2], at->str()) + found[3].str() + found[4].str() +
                         ' ' + at->str() + ';';
        return lines;
    }

    std::string placed(const std::string& layout, const std::string& name) {
        const auto [entry, is_new] = bindings_.try_emplace(name, next_);
        if (is_new) ++next_;
        return "layout(" + layout + (layout.empty() ? "" : ", ") +
               "set = 0, binding = " + std::to_string(entry->second) + ") ";
    }

    const NameCounts& counts_;
    std::map<std::string, unsigned> bindings_;
    unsigned next_ = 0;
};

/// The line of a constant with the chosen value, which `constants` gets, too; "" if nothing names it.
std::string constant_text(const FrameCommand& pass, const std::smatch& line, const NameCounts& counts,
                          std::vector<ExportedConstant>& constants) {
    ExportedConstant constant{.name = line[3], .type = line[2], .value = {}, .id = unsigned(std::stoul(line[1]))};
    if (!is_named(counts, constant.name)) return "";
    constant.parameter = parameter_of(pass.params, constant.name);
    constant.value = glsl_literal(constant.type, bits_of(pass, constant));
    constants.push_back(constant);
    return "layout(constant_id = " + std::to_string(constant.id) + ") const " + constant.type + ' ' + constant.name +
           " = " + constant.value + ";" + (constant.parameter ? note_of(*constant.parameter) : "") + '\n';
}

/// The block `Params` of the members that something names, at their places in the whole block; "" if nothing does.
std::string params_text(const FrameCommand& pass, const NameCounts& counts) {
    std::string members;
    unsigned offset = 0;
    for (const Parameter& p : pass.params) {
        if (p.use != Use::uniform) continue;
        if (is_named(counts, p.glsl_name()))
            members += "    layout(offset = " + std::to_string(offset) + ") " + p.glsl_type + ' ' + p.glsl_name() +
                       ";" + note_of(p) + '\n';
        offset += 4;  // std140 packs scalars one after the other
    }
    return members.empty() ? "" : "layout(std140) uniform Params {\n" + members + "};\n";
}

}  // namespace

std::string glsl_literal(const std::string& type, uint32_t bits) {
    if (type == "bool") return bits ? "true" : "false";
    if (type == "int") return std::to_string(std::bit_cast<int>(bits));
    if (type == "uint") return std::to_string(bits) + "u";
    const std::string digits = shortest_digits(std::bit_cast<float>(bits));
    return digits.find_first_of(".e") == std::string::npos ? digits + ".0" : digits;
}

StandaloneGlsl standalone_glsl(const FrameCommand& pass, const std::string& head) {
    const std::vector<std::string> lines = without_repetition(lines_of(pass.glsl));
    const NameCounts counts = names_in(lines);
    StandaloneGlsl result;
    std::string text;
    bool is_in_params = false, was_empty = true;
    for (const std::string& line : lines) {
        std::smatch found;
        if (is_in_params) {
            is_in_params = line != "};";
        } else if (line == "layout(std140) uniform Params {") {
            is_in_params = true;
            text += params_text(pass, counts);
        } else if (std::regex_match(line, found, constant_line())) {
            text += constant_text(pass, found, counts, result.constants);
        } else if (!line.empty() || !was_empty) {
            text += line + '\n';
        }
        was_empty = line.empty();
    }
    result.text = head + "#version 460\n" + Bindings(pass.recipe, counts).written_into(text);
    return result;
}

std::string fullscreen_vertex_glsl(const std::string& head) {
    return head +
           "#version 460\n"
           "void main() { gl_Position = vec4(vec2(gl_VertexIndex << 1 & 2, gl_VertexIndex & 2) * 2.0 - 1.0, 0.0, 1.0); "
           "}\n";
}
