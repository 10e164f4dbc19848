#include "experiments/watch/error_places.h"

#include "core/error.h"
#include "core/files.h"
#include "core/gpu/pipelines/shader_files.h"

#include <re2/re2.h>
#include <algorithm>
#include <set>
#include <sstream>

namespace fs = std::filesystem;

namespace {

using nlohmann::json;

constexpr size_t most_places = 8, lines_around = 2, longest_line = 240;

/// Whether a file lies below a folder, wherever links lead.
bool is_below(const fs::path& file, const fs::path& folder) {
    std::error_code error;
    const fs::path inside = fs::weakly_canonical(file, error).lexically_relative(fs::weakly_canonical(folder, error));
    return !error && !inside.empty() && *inside.begin() != "..";
}

/// The file that a message means; "" if there is none. A message may hold what a stranger's shader says: no other files
/// than shaders and the technique's own are shown.
fs::path file_named(const std::string& name, const fs::path& copy) {
    std::vector<std::pair<fs::path, fs::path>> tried = {{copy / name, copy}, {copy.parent_path() / name, copy}};
    for (const fs::path& root : shader_roots()) tried.emplace_back(root / name, root);
    std::error_code error;
    for (const auto& [file, root] : tried)
        if (fs::is_regular_file(file, error) && is_below(file, root)) return file;
    return {};
}

std::vector<std::string> lines_of(const fs::path& file) {
    std::istringstream text(read_text(file));
    std::vector<std::string> lines;
    for (std::string line; std::getline(text, line);) lines.push_back(line);
    return lines;
}

json lines_at(const fs::path& file, size_t line) {
    const std::vector<std::string> lines = lines_of(file);
    if (line == 0 || line > lines.size()) return {};
    json shown = json::array();
    for (size_t i = line - std::min(line - 1, lines_around); i <= std::min(line + lines_around, lines.size()); ++i)
        shown.push_back({{"number", i}, {"text", lines[i - 1].substr(0, longest_line)}});
    return shown;
}

void replace_all(std::string& text, const std::string& what, const std::string& by) {
    for (size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + by.size()))
        text.replace(at, what.size(), by);
}

}  // namespace

json error_with_places(std::string text, const fs::path& copy, const fs::path& folder) {
    static const RE2 place(R"(([^\s:()'"]+):(\d{1,6}))");
    json places = json::array();
    std::set<std::pair<std::string, size_t>> known;
    re2::StringPiece rest(text);
    std::string name;
    size_t line = 0;
    while (places.size() < most_places && RE2::FindAndConsume(&rest, place, &name, &line)) {
        const fs::path file = file_named(name, copy);
        if (file.empty() || !known.insert({file.string(), line}).second) continue;
        try {
            if (json lines = lines_at(file, line); !lines.is_null()) {
                const fs::path shown = is_below(file, copy) ? folder / file.lexically_relative(copy) : file;
                places.push_back({{"file", shown.string()}, {"line", line}, {"lines", lines}});
            }
        } catch (const Error&) {  // a file that cannot be read shows no line
        }
    }
    replace_all(text, copy.string(), folder.string());
    return {{"text", text}, {"places", places}};
}
