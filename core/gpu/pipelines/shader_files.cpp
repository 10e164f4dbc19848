#include "core/gpu/pipelines/shader_files.h"

#include "core/error.h"
#include "core/former_names.h"
#include "core/own_files.h"
#include "core/path_inside.h"

#include <fstream>
#include <mutex>
#include <optional>
#include <sstream>

namespace {

/// What set_shader_folder() was given.
class GivenFolders {
public:
    void set(const std::string& folder, ShaderTexts texts) {
        const std::lock_guard lock(mutex_);
        Folder& given = folders_[folder];
        if (given.version > 0 && given.texts == texts) return;
        given.texts = std::move(texts);
        ++given.version;
    }
    unsigned version(const std::string& folder) {
        const std::lock_guard lock(mutex_);
        const auto found = folders_.find(folder);
        return found == folders_.end() ? 0 : found->second.version;
    }
    std::optional<ShaderFile> find(const std::string& folder, const std::string& name) {
        const std::lock_guard lock(mutex_);
        const auto found = folders_.find(folder);
        if (found == folders_.end()) return {};
        const auto text = found->second.texts.find(name);
        if (text == found->second.texts.end()) return {};
        return ShaderFile{folder + "/" + name, text->second};
    }

private:
    struct Folder {
        ShaderTexts texts;
        unsigned version = 0;
    };
    std::mutex mutex_;
    std::map<std::string, Folder> folders_;
};

GivenFolders& given_folders() {
    static GivenFolders folders;
    return folders;
}

std::string folder_of(const std::string& name) { return name.substr(0, name.find('/')); }

}  // namespace

const std::vector<std::filesystem::path>& shader_roots() {
    static const std::filesystem::path root = own_files();
    static const std::vector<std::filesystem::path> roots = {root / "variants", root / "core/shaders",
                                                             root / "tests/shaders", root};
    return roots;
}

void set_shader_folder(const std::string& folder, ShaderTexts texts) { given_folders().set(folder, std::move(texts)); }

unsigned shader_version(const std::string& name) { return given_folders().version(folder_of(name)); }

ShaderFile read_shader(const std::string& name, const std::string& includer, const std::string& asked_for_by) {
    if (const auto file = given_folders().find(folder_of(includer), name)) return *file;
    if (const std::string folder = folder_of(name); folder.size() < name.size())
        if (const auto file = given_folders().find(folder, name.substr(folder.size() + 1))) return *file;
    for (const auto& root : shader_roots()) {
        const std::filesystem::path file =
            path_inside(root, present_path(name), "the shader '" + name + "'" + asked_for_by);
        if (std::ifstream in(file); std::filesystem::is_regular_file(file) && in)
            return {name, {std::istreambuf_iterator<char>(in), {}}};
    }
    fail("no shader file ", name, asked_for_by,
         ", under variants/, core/shaders/, tests/shaders/ or the project's root");
}

std::string included_by(const std::string& line) {
    static constexpr std::string_view include = "#include \"";
    if (!line.starts_with(include)) return {};
    return line.substr(include.size(), line.rfind('"') - include.size());
}

std::vector<ShaderInclude> includes_of(const std::string& text) {
    std::vector<ShaderInclude> includes;
    std::istringstream lines(text);
    int number = 0;
    for (std::string line; std::getline(lines, line);) {
        ++number;
        if (const std::string name = included_by(line); !name.empty()) includes.push_back({name, number});
    }
    return includes;
}
