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

/// From now on what is called `folder`/NAME is `texts`[NAME], whatever lies under shader_roots(), and what these
/// shaders include is looked for among them first. Replaces the texts that were given for that folder before. Of
/// techniques that come from anywhere: what was read and judged is what is compiled, even if someone edits it
/// meanwhile.
void set_shader_folder(const std::string& folder, ShaderTexts texts);

/// How often the texts of a shader's folder have changed: what was compiled before holds for an earlier number. 0 of
/// shaders under shader_roots(), which are read once in a process.
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
/// All of them in a text.
std::vector<ShaderInclude> includes_of(const std::string& text);
