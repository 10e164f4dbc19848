#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <vector>

/// The folders under which shaders and their includes are found: techniques, core/shaders, tests/shaders, the project
/// itself.
const std::vector<std::filesystem::path>& shader_roots();

/// Shaders by their paths in a folder.
using ShaderTexts = std::map<std::string, std::string>;

/// Makes `texts`[NAME] the shader `folder`/NAME, whatever lies under shader_roots(). Includes of these shaders are
/// looked for in `texts` first. Replaces the folder's earlier texts. For techniques from outside ssrlab: the text that
/// was checked is compiled, even if someone edits the file meanwhile.
void set_shader_folder(const std::string& folder, ShaderTexts texts);

/// How often the texts of a shader's folder have changed, to recognise outdated compiled shaders. 0 for shaders under
/// shader_roots(), which are read once per process.
unsigned shader_version(const std::string& name);

struct ShaderFile {
    std::string name;  ///< within shader_roots(), or with the folder of set_shader_folder()
    std::string text;
};

/// `includer`: the name of the file that includes it; "": none. `asked_for_by`: ", which FILE:LINE includes", or
/// nothing. Fails with Error if there is no such file, and on names that lead out of these folders.
ShaderFile read_shader(const std::string& name, const std::string& includer = "", const std::string& asked_for_by = "");

struct ShaderInclude {
    std::string name;
    int line = 0;  ///< from 1
};
/// "x" of a line `#include "x"`; "" of all others.
std::string included_by(const std::string& line);
/// All includes of a text.
std::vector<ShaderInclude> includes_of(const std::string& text);
