#include "experiments/live/watch/error_places.h"

#include "core/error.h"
#include "core/files.h"
#include "core/gpu/pipelines/shader_files.h"
#include "core/path_inside.h"

#include <re2/re2.h>
#include <algorithm>
#include <optional>
#include <set>
#include <sstream>

namespace fs = std::filesystem;

namespace {

using nlohmann::json;

constexpr size_t most_places = 8, lines_around = 2, longest_line = 240;

/// A file that a message names, and as its author knows it.
struct NamedFile {
    fs::path file, shown;
};

/// A message may hold what a stranger's shader says: no other files are shown than shaders and the technique's own.
std::optional<NamedFile> file_named(const std::string& name, const fs::path& copy, const fs::path& folder) {
    const auto found = [](const fs::path& root, const std::string& inside, const fs::path& shown) {
        std::error_code error;
        std::optional<NamedFile> named;
        try {
            const fs::path file = path_inside(root, inside);
            if (fs::is_regular_file(file, error)) named = NamedFile{file, path_inside(shown, inside)};
        } catch (const Error&) {  // it leads elsewhere
        }
        return named;
    };
    const fs::path path = name;
    for (const fs::path& own : {path.lexically_relative(copy), path.lexically_relative(copy.filename()), path})
        if (const auto found_own = found(copy, own.string(), folder)) return found_own;
    for (const fs::path& root : shader_roots())
        if (const auto shared = found(root, name, root)) return shared;
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
        const auto named = file_named(name, copy, folder);
        if (!named || !known.insert({named->file.string(), line}).second) continue;
        try {
            if (json lines = lines_at(named->file, line); !lines.is_null())
                places.push_back({{"file", named->shown.string()}, {"line", line}, {"lines", lines}});
        } catch (const Error&) {  // a file that cannot be read shows no line
        }
    }
    replace_all(text, copy.string(), folder.string());
    return {{"text", text}, {"places", places}};
}
