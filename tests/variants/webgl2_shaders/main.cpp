#include "core/error.h"
#include "core/gpu/pipelines/shader.h"
#include "variants/registry.h"

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <filesystem>
#include <set>
#include <string_view>
#include <unordered_map>

// Prints, for the test that compiles them in a browser, the GLSL ES 3.00 of every shader of every technique that keeps
// to WebGL 2: of its defaults, of each preset, and of some of these with one parameter changed. A JSON array of objects
// with `name`, `vertex` and `fragment`; what differs in nothing that the shader uses comes once.

namespace {

std::vector<std::string> fragment_shaders(const std::string& folder) {
    std::vector<std::string> files;
    for (const auto& file : std::filesystem::directory_iterator(SSRLAB_SOURCE_DIR "/variants/" + folder))
        if (file.path().extension() == ".frag") files.push_back(folder + "/" + file.path().filename().string());
    return files;
}

/// What else a parameter may be, as far as sources know: uniforms are no part of them, and of numbers the ends of the
/// range stand for all.
std::vector<nlohmann::json> other_values(const Parameter& p) {
    if (p.use == Use::uniform) return {};
    std::vector<nlohmann::json> values;
    if (!p.choices.empty())
        values.assign(p.choices.begin(), p.choices.end());
    else if (p.glsl_type == "bool")
        values = {false, true};
    else
        values = {p.min, p.max};
    std::erase(values, p.value);
    return values;
}

bool is_part_of_a_word(char c) { return std::isalnum(uint8_t(c)) || c == '_'; }

/// How often each word comes outside of comments. By hand: std::regex takes 20 times as long, 10 s for all sources.
std::unordered_map<std::string_view, int> word_counts(std::string_view source) {
    std::unordered_map<std::string_view, int> counts;
    for (size_t at = 0; at < source.size();) {
        const std::string_view rest = source.substr(at);
        if (rest.starts_with("//")) {
            at = std::min(source.find('\n', at), source.size());
        } else if (rest.starts_with("/*")) {
            at = std::min(source.find("*/", at + 2), source.size() - 2) + 2;
        } else if (is_part_of_a_word(rest.front())) {
            const auto end = std::ranges::find_if_not(rest, is_part_of_a_word);
            ++counts[rest.substr(0, size_t(end - rest.begin()))];
            at += size_t(end - rest.begin());
        } else {
            ++at;
        }
    }
    return counts;
}

/// NAME of a line `const TYPE NAME = VALUE;`, else nothing. By hand, too.
std::string_view declared_constant(std::string_view line) {
    if (!line.starts_with("const ") || !line.ends_with(';')) return {};
    line.remove_prefix(6);
    const size_t type_end = line.find(' '), name_end = line.find(" = ");
    if (type_end >= name_end || name_end == line.npos) return {};
    const std::string_view type = line.substr(0, type_end), name = line.substr(type_end + 1, name_end - type_end - 1);
    return std::ranges::all_of(type, is_part_of_a_word) && std::ranges::all_of(name, is_part_of_a_word) ? name : "";
}

/// Without the constants that the shader does not name.
std::string what_counts(std::string_view source) {
    const auto words = word_counts(source);
    std::string result;
    while (!source.empty()) {
        const std::string_view line = source.substr(0, source.find('\n'));
        source.remove_prefix(std::min(line.size() + 1, source.size()));
        const std::string_view name = declared_constant(line);
        if (name.empty() || words.at(name) != 1) result += line;
        result += '\n';
    }
    return result;
}

struct Sources {
    nlohmann::json list = nlohmann::json::array();
    std::set<std::string> seen;

    void add(const TechniqueEntry& entry, const Technique& technique, const std::string& point) {
        if (technique.limits != Limits::webgl2) return;  // lifted by the changed parameter
        const std::string prelude = shader_prelude(technique.params, ShaderLanguage::webgl2);
        for (const std::string& folder : {entry.name, std::string("common")})
            for (const std::string& file : fragment_shaders(folder)) {
                const Webgl2Sources sources = webgl2_sources(file, prelude, technique.shader_includes());
                if (!seen.insert(file + '\n' + what_counts(sources.fragment)).second) continue;
                list.push_back({{"name", file + " of " + entry.name + point},
                                {"vertex", sources.vertex},
                                {"fragment", sources.fragment},
                                {"files", sources.files}});
            }
    }
};

Sources all_sources() {
    Sources sources;
    for (const TechniqueEntry& entry : technique_table()) {
        if (entry.limits.api != Limits::webgl2) continue;
        std::vector<std::string> presets = {""};
        for (const Preset& preset : entry.presets) presets.push_back(preset.name);
        if (!std::ranges::count(presets, "corrected")) fail(entry.name, " has no preset 'corrected'");
        for (const std::string& preset : presets) {
            const auto technique = make_technique(entry.name, {}, preset);
            const std::string point = preset.empty() ? "" : ", preset " + preset;
            sources.add(entry, *technique, point);
            // Around the defaults and the preset with most corrections on; around the others it would be twice as many
            // shaders.
            if (!preset.empty() && preset != "corrected") continue;
            for (const Parameter& p : technique->params)
                for (const nlohmann::json& value : other_values(p))
                    sources.add(entry, *make_technique(entry.name, {{p.name, value}}, preset),
                                point + ", " + p.name + " = " + value.dump());
        }
    }
    return sources;
}

}  // namespace

int main() {
    try {
        std::puts(all_sources().list.dump().c_str());
    } catch (const Error& e) {
        std::fprintf(stderr, "error: %s\n", e.what());
        return 2;
    }
}
