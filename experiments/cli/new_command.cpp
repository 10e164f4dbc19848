// ssrlab new: a technique of one's own, as a folder, from one that is there.
#include "core/error.h"
#include "core/files.h"
#include "core/near_miss.h"
#include "core/own_files.h"
#include "core/path_inside.h"
#include "core/shown_text.h"
#include "experiments/cli/commands.h"
#include "variants/declared/declared_entry.h"
#include "variants/registry.h"

#include <algorithm>
#include <cstdio>
#include <regex>

namespace {

struct NewOptions {
    std::filesystem::path folder;      ///< that is to be made
    std::string from = "mcguire_dda";  ///< a technique's name, or its folder
};

namespace fs = std::filesystem;

/// The folder that `from` names: one of ssrlab's, or one of the user's own.
fs::path folder_of(const std::string& from) {
    if (from.find('/') != std::string::npos) return from;
    return find_technique(from).folder->path;
}

std::string with_names(std::string text, const std::map<std::string, std::string>& new_names) {
    for (const auto& [before, after] : new_names)
        for (size_t at = 0; (at = text.find("\"" + before + "\"", at)) != std::string::npos; ++at)
            text.replace(at, before.size() + 2, "\"" + after + "\"");
    return text;
}

/// Behind the value that begins at `at` with a bracket, in JSON with `//` comments.
size_t end_of_array(const std::string& json, size_t at) {
    int depth = 0;
    for (; at < json.size(); ++at) {
        if (json[at] == '"') {
            while (json[++at] != '"') at += json[at] == '\\';
        } else if (json.compare(at, 2, "//") == 0) {
            at = json.find('\n', at);
        } else if (json[at] == '[') {
            ++depth;
        } else if (json[at] == ']' && --depth == 0) {
            return at + 1;
        }
    }
    return at;
}

/// A declaration that was read without an error, without presets: they name parameters that the copy's author may
/// remove, and their values were found for the origin.
std::string without_presets(const std::string& declaration) {
    const std::regex presets(R"("presets"\s*:\s*\[)");
    std::smatch found;
    if (!std::regex_search(declaration, found, presets)) return declaration;
    const size_t at = size_t(found.position(0) + found.length(0)) - 1;
    return declaration.substr(0, at) + "[]" + declaration.substr(end_of_array(declaration, at));
}

/// Content by file of the technique, with the shaders that it has of ssrlab's technique of its own name beside it.
std::map<std::string, std::string> files_of(const TechniqueEntry& technique) {
    std::map<std::string, std::string> files = technique.folder->files, new_names;
    const std::string shared = "variants/", own = shared + technique.name + "/";
    for (const std::string& source : technique.folder->sources) {
        if (!source.starts_with(own)) continue;
        const std::string name = source.substr(own.size());
        files[name] = read_text(path_inside(own_files(), source));
        new_names[source.substr(shared.size())] = name;
    }
    files.erase("tuned_presets.json");
    files["technique.json"] = without_presets(files.at("technique.json"));
    for (auto& [name, text] : files) text = with_names(std::move(text), new_names);
    return files;
}

/// A first study of it, beside what it was made from.
std::string study_of(const std::string& name, const std::string& from) {
    const nlohmann::json of_origin = from.find('/') == std::string::npos
                                         ? nlohmann::json({{"technique", from}})
                                         : nlohmann::json({{"technique", fs::absolute(from).lexically_normal()}});
    const nlohmann::json study = {{"title", name},
                                  {"shots", {{{"scene", "fence"}, {"resolution", {240, 135}}, {"warm_up", 4}}}},
                                  {"lit", "direct"},
                                  {"reference", {{"samples", 64}}},
                                  {"techniques", {{{"technique", "none"}}, of_origin, {{"technique", "./"}}}}};
    return study.dump(2) + "\n";
}

}  // namespace

static void new_command(const NewOptions& options) {
    const std::string name = declared_name(options.folder);
    std::error_code error;
    if (fs::exists(fs::symlink_status(options.folder, error)))
        fail(options.folder.string(), " is there already; choose another name, or remove it");
    if (std::ranges::count(technique_table(), name, &TechniqueEntry::name))
        fail("'", name, "' is one of ssrlab's own techniques; give the folder another name");
    const TechniqueEntry technique = declared_entry(folder_of(options.from));
    const std::string study = name + ".json";
    write_atomically(whole_path(options.folder), [&](const fs::path& made) {
        for (const auto& [file, text] : files_of(technique)) write_text(path_inside(made, file), text);
        write_text(path_inside(made, study), study_of(name, options.from));
    });
    add_technique_folder(options.folder);  // or says what is wrong with it
    std::printf("%s: technique.json and its shaders. A first study: ssrlab run %s\n",
                shown_text(options.folder.string()).c_str(), shown_text((options.folder / study).string()).c_str());
}

void add_new(Commands& line) {
    NewOptions& new_technique = line.keep<NewOptions>();
    CLI::App& command =
        line.add("new", "Write a folder with a technique of your own, which needs no compiler, and a first study of it",
                 "ssrlab new my_ssr --from mcguire_dda");
    option(command, "folder FOLDER", new_technique.folder, "Folder to make; its name is the name of the technique")
        ->required();
    option(command, "--from TECHNIQUE", new_technique.from,
           "Technique to copy: mcguire_dda, simple_ssr, four_mode_ssr, or the folder of a technique; default: "
           "mcguire_dda");
    command.callback([&] { new_command(new_technique); });
}
