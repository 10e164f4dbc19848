#include "core/gpu/pipelines/shader.h"

#include "core/error.h"
#include "core/gpu/pipelines/glsl_compiler/glsl_compiler.h"
#include "core/gpu/pipelines/shader_cache.h"
#include "core/gpu/pipelines/shader_error.h"
#include "core/gpu/pipelines/shader_files.h"
#include "core/list_text.h"
#include "core/parameters.h"

#include <algorithm>
#include <regex>
#include <sstream>

namespace {

/// On the near plane. `vertex`: the language's number of the vertex, 0 to 2; `near`: the API's clip z of that plane.
std::string fullscreen_triangle(const std::string& vertex, const std::string& near) {
    return "void main() { gl_Position = vec4(vec2(" + vertex + " << 1 & 2, " + vertex + " & 2) * 2.0 - 1.0, " + near +
           ", 1.0); }\n";
}

const char* const webgl2_version = "#version 300 es\n";

/// GLSL ES 3.00 gives samplers low or no default precision, and knows no push constants: a uniform block takes their
/// place, in which floats, ints and vec4 lie at the same offsets.
const char* const webgl2_preamble =
    "precision highp float;\n"
    "precision highp int;\n"
    "precision highp sampler2D;\n"
    "precision highp usampler2D;\n"
    "#define push_constant std140\n";

// The largest of ssrlab's own shaders has 79 files, 10 within each other, of 122 kB.
constexpr size_t most_nested_files = 100, most_files = 2000, most_source_bytes = 16 << 20;

struct SourceFile {
    std::string name;
    size_t includer = 0;    ///< index of the file that includes it
    int line = 0;           ///< there; 0: none
    std::string text = {};  ///< once it was read
};

/// Refuses what `place` includes if the shader would not end: a file within itself, and files that include others more
/// often than a compiler can take.
void check_include(const SourceFile& included, const std::string& place, const std::vector<SourceFile>& files) {
    size_t nested = 1;
    for (size_t file = included.includer;; file = files[file].includer, ++nested) {
        if (files[file].name == included.name) fail(included.name, " includes itself, at ", place);
        if (files[file].line == 0) break;
    }
    if (nested > most_nested_files)
        fail(place, " includes ", included.name, " within more than ", most_nested_files, " other files");
    size_t bytes = included.text.size();
    for (const SourceFile& file : files) bytes += file.text.size();
    if (bytes > most_source_bytes || files.size() >= most_files)
        fail(place, " includes ", included.name, ", and the shader then has more than ", most_source_bytes >> 20,
             " MiB or ", most_files, " files; does a file include another one many times?");
}

/// Replaces #include "x" by the text of x. Files guard themselves against double inclusion. Each file has a number, its
/// index in `files`, which #line carries into the compiler's messages.
std::string expand_includes(const std::string& text, size_t file, const ShaderIncludes& includes,
                            std::vector<SourceFile>& files) {
    std::istringstream in(text);
    std::ostringstream out;
    int number = 0;
    for (std::string line; std::getline(in, line);) {
        ++number;
        const std::string asked = included_by(line);
        if (asked.empty()) {
            out << line << '\n';
            continue;
        }
        const std::string place = files[file].name + ":" + std::to_string(number);
        const auto decided = includes.find(asked);
        const auto [name, content] = decided != includes.end()
                                         ? ShaderFile{asked, decided->second}
                                         : read_shader(asked, files[file].name, ", which " + place + " includes");
        const SourceFile included_file{name, file, number, content};
        check_include(included_file, place, files);
        files.push_back(included_file);
        const size_t included = files.size() - 1;
        out << "#line 1 " << included << '\n'
            << expand_includes(content, included, includes, files) << "#line " << number + 1 << ' ' << file << '\n';
    }
    return out.str();
}

/// What stands around a shader whose prelude is shader_prelude_for_cpu().
const char* const before_main_for_cpu = "#define main shader_main\n";
const char* const main_for_cpu =
    "#undef main\nvoid main() {\n    copy_camera();\n    copy_params();\n    shader_main();\n}\n";

/// The shader `files[index]` behind the prelude, which is file 0, with its includes, which are added to `files`.
std::string complete_source(const std::string& prelude, size_t index, const ShaderIncludes& includes,
                            std::vector<SourceFile>& files, bool is_for_cpu = false) {
    files[index].text = read_shader(files[index].name).text;
    const std::string text = files[index].text;  // files grows
    const std::string begin = files[index].name.ends_with(".comp") ? "#define COMPUTE_SHADER\n#line 1 0\n" : "";
    return begin + expand_includes(prelude, 0, includes, files) + (is_for_cpu ? before_main_for_cpu : "") + "#line 1 " +
           std::to_string(index) + "\n" + expand_includes(text, index, includes, files) +
           (is_for_cpu ? main_for_cpu : "");
}

std::string with_changes(std::string source, const ShaderChanges& changes) {
    if (!changes.image_formats.empty()) source = with_image_formats(source, changes.image_formats);
    for (const GlslChange& change : changes.glsl) source = change.apply(source);
    return source;
}

std::string webgl2_fragment(const std::string& prelude, const ShaderIncludes& includes,
                            std::vector<SourceFile>& files) {
    return std::string(webgl2_version) + webgl2_preamble + "#line 1 0\n" + complete_source(prelude, 1, includes, files);
}

/// " (included by FILE:LINE, FILE:LINE)", from the nearest to the shader itself; "" for that.
std::string includers(size_t file, const std::vector<SourceFile>& files) {
    std::string text;
    for (; files[file].line > 0; file = files[file].includer)
        text += (text.empty() ? " (included by " : ", ") + files[files[file].includer].name + ":" +
                std::to_string(files[file].line);
    return text.empty() ? "" : text + ")";
}

/// Line `number`, from 1, without the blanks around it; "" if there is none.
std::string line_of(const std::string& text, int number) {
    std::istringstream lines(text);
    std::string line;
    for (int i = 0; i < number; ++i)
        if (!std::getline(lines, line)) return {};
    const size_t first = line.find_first_not_of(" \t\r");
    return first == std::string::npos ? "" : line.substr(first, line.find_last_not_of(" \t\r") + 1 - first);
}

/// What glslang says, with names of files, and below each message the line that it is about. glslang writes
/// "ERROR: 3:17: ..." for line 17 of file 3, and after the first error some about "", which say nothing.
std::string with_file_names(const std::string& log, const std::vector<SourceFile>& files) {
    std::istringstream in(log);
    std::ostringstream out;
    bool is_first = true;
    for (std::string line; std::getline(in, line);) {
        unsigned file = 0;
        int consumed = 0;
        if (std::sscanf(line.c_str(), "ERROR: %u:%n", &file, &consumed) == 1 && consumed && file < files.size()) {
            if (!is_first && line.find(": '' :") != std::string::npos) continue;
            const int number = std::atoi(line.c_str() + consumed);
            line = files[file].name + ":" + line.substr(size_t(consumed)) + (is_first ? includers(file, files) : "");
            if (const std::string written = line_of(files[file].text, number); !written.empty())
                line += "\n    " + written;
            is_first = false;
        }
        if (!line.empty()) out << line << '\n';
    }
    return out.str();
}

void throw_failure(const CompiledGlsl& stage, const std::string& file, const std::vector<SourceFile>& files) {
    switch (stage.failure) {
        case CompiledGlsl::Failure::none:
            return;
        case CompiledGlsl::Failure::of_compiler:
            throw ShaderError("cannot compile " + file + ":\n" + with_file_names(stage.why, files));
        case CompiledGlsl::Failure::of_linker:
            throw ShaderError("cannot link " + file + ":\n" + with_file_names(stage.why, files));
        case CompiledGlsl::Failure::of_bindings:
            throw ShaderError(file + ": " + stage.why + "\n");
    }
}

/// "FILE:LINE: #extension ..." of each extension that the files turn on, one in a line.
std::string extension_lines(const std::vector<SourceFile>& files) {
    std::string lines;
    for (const SourceFile& file : files) {
        std::istringstream in(file.text);
        int number = 0;
        for (std::string line; std::getline(in, line);) {
            ++number;
            const size_t hash = line.find_first_not_of(" \t");
            if (hash == line.npos || line[hash] != '#' || line.find("extension") == line.npos) continue;
            lines += file.name + ":" + std::to_string(number) + ": " + line.substr(hash) + "\n";
        }
    }
    return lines;
}

}  // namespace

std::string with_image_formats(const std::string& glsl, const std::map<std::string, Format>& formats) {
    static const std::regex declaration(R"((layout\s*\(\s*)(\w+)(\s*\)\s*uniform\b[^;{]*;))"), word(R"(\w+)");
    std::string text;
    auto rest = glsl.begin();
    for (std::sregex_iterator at(glsl.begin(), glsl.end(), declaration), end; at != end; ++at) {
        const std::smatch& found = *at;
        std::string format = found[2];
        for (std::sregex_iterator name(found[3].first, found[3].second, word); name != end; ++name)
            if (const auto changed = formats.find(name->str()); changed != formats.end())
                format = name_of(changed->second);
        text.append(rest, found[2].first).append(format);
        rest = found[2].second;
    }
    return text.append(rest, glsl.end());
}

const std::vector<SceneConstant>& scene_constants() {
    static const std::vector<SceneConstant> constants = {
        {"scene_is_still", 1000, false},          // motion vectors are 0
        {"scene_has_environment", 1003, true},    // it is not black
        {"scene_has_matte", 1004, true},          // some surface has no specular term
        {"scene_has_normal_maps", 1001, true},    // some material bends its shading normal
        {"scene_has_vertex_colors", 1002, true},  // some vertex is not white
    };
    return constants;
}

namespace {

std::string glsl_of_scene_constants(bool is_webgl2) {
    std::string constants;
    for (const SceneConstant& c : scene_constants())
        constants += (is_webgl2 ? "" : "layout(constant_id = " + std::to_string(c.id) + ") ") + "const bool " + c.name +
                     (c.initial ? " = true;\n" : " = false;\n");
    return constants;
}

const std::string camera_block =
    "#include \"core/shared/camera.h\"\nlayout(std140) uniform Camera { CameraData camera; }";

}  // namespace

std::string shader_prelude(const ParameterSet& params, ShaderLanguage language) {
    const bool is_webgl2 = language == ShaderLanguage::webgl2;
    return camera_block + ";\n" + glsl_of_scene_constants(is_webgl2) + params.glsl(is_webgl2);
}

std::string shader_prelude_for_cpu(const ParameterSet& params) {
    return camera_block + " camera_block;\nCameraData camera;\n#include \"core/shaders/copy_camera.glsl\"\n" +
           glsl_of_scene_constants(false) + params.glsl_with_copies();
}

Webgl2Sources webgl2_sources(const std::string& file, const std::string& prelude, const ShaderIncludes& includes) {
    std::vector<SourceFile> files = {{"prelude"}, {file}};
    Webgl2Sources sources{.vertex = webgl2_version + fullscreen_triangle("gl_VertexID", "-1.0"),
                          .fragment = webgl2_fragment(prelude, includes, files),
                          .files = {}};
    for (const SourceFile& f : files) sources.files.push_back(f.name);
    return sources;
}

Shader compile(const std::string& file, const std::string& vertex_file, const std::string& prelude,
               const ShaderIncludes& includes, ShaderLanguage language, const ShaderChanges& changes) {
    const bool webgl2 = language == ShaderLanguage::webgl2, is_compute = file.ends_with(".comp");

    std::vector<SourceFile> files = {{"prelude"}, {file}};
    std::vector<GlslSource> sources;
    if (!is_compute && !webgl2) {
        if (vertex_file.empty()) {
            sources.push_back({GlslStage::vertex, language, fullscreen_triangle("gl_VertexIndex", "0.0")});
        } else {
            files.push_back({vertex_file});
            sources.push_back({GlslStage::vertex, language,
                               complete_source(prelude, files.size() - 1, includes, files, changes.is_for_cpu)});
        }
    }
    sources.push_back({is_compute ? GlslStage::compute : GlslStage::fragment, language,
                       webgl2
                           ? webgl2_fragment(prelude, includes, files)
                           : with_changes(complete_source(prelude, 1, includes, files, changes.is_for_cpu), changes)});

    std::vector<std::string> compiled = {webgl2 ? "webgl2" : "vulkan"};
    for (const GlslSource& source : sources) compiled.push_back(std::to_string(int(source.stage)) + '\n' + source.text);
    const std::string key = ShaderCache::key_of(compiled);
    if (std::optional<Shader> kept = ShaderCache::find(key)) return *std::move(kept);

    Shader result;
    for (const GlslSource& source : sources) {
        const std::string& own_file = source.stage == GlslStage::vertex ? vertex_file : file;
        CompiledGlsl stage = compile_glsl(source, result.interface);
        throw_failure(stage, own_file, files);
        if (webgl2) break;
        if (!stage.foreign.empty())
            throw ShaderError(own_file + " uses what ssrlab's devices are not created with: " +
                              joined(stage.foreign, ", ") + "\n" + extension_lines(files));
        result.spirv.push_back(std::move(stage.spirv));
    }
    ShaderCache::keep(key, result);
    return result;
}
