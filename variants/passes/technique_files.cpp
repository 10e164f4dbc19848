#include "variants/passes/technique_files.h"

#include "core/error.h"
#include "core/files.h"
#include "core/former_names.h"
#include "core/gpu/pipelines/shader_files.h"
#include "core/near_miss.h"
#include "core/own_files.h"
#include "core/path_inside.h"
#include "variants/passes/declared_passes.h"

#include <algorithm>
#include <map>
#include <mutex>
#include <optional>
#include <set>

namespace fs = std::filesystem;

namespace {

bool is_shader_source(const fs::path& file) {
    static const std::set<std::string> endings = {".comp", ".frag", ".glsl", ".h"};
    return endings.contains(file.extension().string());
}

/// One of ssrlab's own shaders.
struct OwnShader {
    std::string source;  ///< its path from ssrlab's root
    std::string text;
};

std::optional<OwnShader> find_own_shader(const std::string& name) {
    if (name.empty() || fs::path(name).is_absolute() || std::ranges::count(fs::path(name), fs::path("..")) > 0)
        return {};
    for (const fs::path& root : shader_roots()) {
        const fs::path file = path_inside(root, present_path(name));
        const std::string inside = file.lexically_relative(own_files()).string();
        if ((inside.starts_with("variants/") || inside.starts_with("core/")) && is_shader_source(file) &&
            fs::is_regular_file(file))
            return OwnShader{inside, read_text(file)};
    }
    return {};
}

/// Null if there is none of that name. Read once per process: the passes of all techniques include the same ones.
const OwnShader* own_shader(const std::string& name) {
    static std::mutex mutex;
    static std::map<std::string, std::optional<OwnShader>> read;
    const std::lock_guard lock(mutex);
    auto found = read.find(name);
    if (found == read.end()) found = read.emplace(name, find_own_shader(name)).first;
    return found->second ? &*found->second : nullptr;
}

/// Names of shaders below a folder.
void add_names(const fs::path& folder, std::vector<std::string>& names) {
    std::error_code error;
    for (const auto& entry : fs::recursive_directory_iterator(folder, error))
        if (is_shader_source(entry.path())) names.push_back(entry.path().lexically_relative(folder).string());
}

/// Follows the includes of one pass.
class Reader {
public:
    Reader(const Declaration& declaration, const DeclaredPass& pass, TechniqueFolder& read)
        : declaration_(declaration), pass_(pass), read_(read) {}

    /// Whether the shader is one of the folder.
    bool read_shader(const std::string& name) { return visit(name, true, pass_.place + ": 'shader' = '" + name + "'"); }
    bool read_include(const std::string& name) { return visit(name, true, pass_.place + ": 'file' = '" + name + "'"); }

private:
    /// `may_be_of_folder`: false for what ssrlab's own shaders include. `where`: who names it.
    bool visit(const std::string& name, bool may_be_of_folder, const std::string& where) {
        const bool is_of_folder = may_be_of_folder && is_in_folder(name, where);
        const OwnShader* const own = is_of_folder ? nullptr : own_shader(name);
        if (!is_of_folder && !own) fail_missing(name, where);
        const std::string shown_name = is_of_folder ? declaration_.name + "/" + name : own->source;
        if (std::ranges::count(open_, shown_name) > 0) fail(where, ": ", shown_name, " includes itself");
        if (!visited_.insert(shown_name).second) return is_of_folder;
        const std::string text = own ? own->text : read_text(path_inside(read_.path, name));
        if (own)
            read_.sources.push_back(own->source);
        else
            read_.files[name] = text;
        open_.push_back(shown_name);
        for (const auto& [included, line] : includes_of(text))
            if (!std::ranges::count(pass_.tracers, included) &&
                !std::ranges::count(pass_.includes, included, &DeclaredInclude::name))
                visit(included, is_of_folder,
                      shown_name + ":" + std::to_string(line) + ": #include \"" + shortened(included) + "\"");
        open_.pop_back();
        return is_of_folder;
    }

    bool is_in_folder(const std::string& name, const std::string& where) const {
        std::error_code error;
        return fs::is_regular_file(path_inside(read_.path, name, where), error);
    }

    [[noreturn]] void fail_missing(const std::string& name, const std::string& where) const {
        for (const TracerSlot& slot : declaration_.slots)
            if (slot.name == name)
                fail(where, ": the pass does not name the tracer; write \"tracers\": \"", name, "\"");
        std::vector<std::string> names;
        add_names(read_.path, names);
        for (const char* folder : {"variants", "core/shaders"}) add_names(own_files() / folder, names);
        const std::string near = nearest_name(name, names);
        fail(where, ": there is no such shader in ", read_.path.string(),
             ", and none of ssrlab under variants/ or core/", near.empty() ? "" : "; did you mean '" + near + "'?");
    }

    const Declaration& declaration_;
    const DeclaredPass& pass_;
    TechniqueFolder& read_;
    std::vector<std::string> open_;  ///< files, each included by the one before
    std::set<std::string> visited_;
};

}  // namespace

void read_shaders(Declaration& declaration, TechniqueFolder& read) {
    for (DeclaredPass& pass : declaration.passes) {
        if (pass.forms.empty()) continue;
        Reader reader(declaration, pass, read);
        for (DeclaredInclude& include : pass.includes)
            if (reader.read_include(include.file)) include.file = declaration.name + "/" + include.file;
        for (DeclaredForm& form : pass.forms)
            if (reader.read_shader(form.shader)) form.shader = declaration.name + "/" + form.shader;
        const std::string& shader = pass.forms.back().shader;
        const std::string stem = shader.substr(0, shader.rfind('.'));
        pass.stage = pass.stage.empty() ? stem : stem.substr(0, stem.rfind('/') + 1) + pass.stage;
    }
    for (const DeclaredPyramid& pyramid : declaration.pyramids)
        for (const std::string& shader :
             std::ranges::find(pyramid_makers(), pyramid.maker, &NamedPyramidMaker::name)->shaders)
            Reader(declaration, DeclaredPass(), read).read_shader(shader);
    std::ranges::sort(read.sources);
    read.sources.erase(std::ranges::unique(read.sources).begin(), read.sources.end());
}
