#include "core/error.h"
#include "core/gpu/pipelines/shader.h"
#include "variants/registry.h"

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <filesystem>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string_view>

// Prints, for the test that compiles them in a browser, the GLSL ES 3.00 of every shader of every technique that keeps
// to WebGL 2: of its defaults, of each preset, and of each of these with one parameter changed. A JSON array of objects
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

/// How often each word comes outside of comments. By hand: std::regex takes 20 times as long, 10 s for all sources.
std::map<std::string_view, int> word_counts(std::string_view source) {
    const auto is_part = [](char c) { return std::isalnum(uint8_t(c)) || c == '_'; };
    std::map<std::string_view, int> counts;
    for (size_t at = 0; at < source.size();) {
        const std::string_view rest = source.substr(at);
        if (rest.starts_with("//")) {
            at = std::min(source.find('\n', at), source.size());
        } else if (rest.starts_with("/*")) {
            at = std::min(source.find("*/", at + 2), source.size() - 2) + 2;
        } else if (is_part(rest.front())) {
            const auto end = std::ranges::find_if_not(rest, is_part);
            ++counts[rest.substr(0, size_t(end - rest.begin()))];
            at += size_t(end - rest.begin());
        } else {
            ++at;
        }
    }
    return counts;
}

/// Without the constants that the shader does not name.
std::string what_counts(const std::string& source) {
    static const std::regex declaration(R"(^const \w+ (\w+) = .*;$)");
    const std::map<std::string_view, int> words = word_counts(source);
    std::string result;
    std::istringstream in(source);
    std::smatch match;
    for (std::string line; std::getline(in, line); result += line + '\n')
        if (line.starts_with("const ") && std::regex_match(line, match, declaration) &&
            words.at(std::string_view(&*match[1].first, size_t(match[1].length()))) == 1)
            line.clear();
    return result;
}

struct Sources {
    nlohmann::json list = nlohmann::json::array();
    std::set<std::string> seen;

    void add(const VariantEntry& entry, const Variant& variant, const std::string& point) {
        if (variant.limits != Limits::webgl2) return;  // lifted by the changed parameter
        const std::string prelude = shader_prelude(variant.params, ShaderLanguage::webgl2);
        for (const std::string& folder : {entry.name, std::string("common")})
            for (const std::string& file : fragment_shaders(folder)) {
                const Webgl2Sources sources = webgl2_sources(file, prelude, variant.shader_includes());
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
    for (const VariantEntry& entry : variant_table()) {
        if (entry.limits.api != Limits::webgl2) continue;
        std::vector<std::string> presets = {""};
        for (const Preset& preset : entry.presets) presets.push_back(preset.name);
        for (const std::string& preset : presets) {
            const auto variant = make_variant(entry.name, {}, preset);
            const std::string point = preset.empty() ? "" : ", preset " + preset;
            sources.add(entry, *variant, point);
            for (const Parameter& p : variant->params)
                for (const nlohmann::json& value : other_values(p))
                    sources.add(entry, *make_variant(entry.name, {{p.name, value}}, preset),
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
