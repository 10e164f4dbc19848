#include "experiments/results/cells/source_code.h"

#include "core/error.h"
#include "core/files.h"

#include <algorithm>
#include <array>
#include <sstream>

namespace fs = std::filesystem;

namespace {

constexpr std::array<std::string_view, 5> source_folders = {"core", "experiments", "groundtruth", "metrics",
                                                            "variants"};
constexpr std::array<std::string_view, 7> source_endings = {".cpp", ".h", ".comp", ".frag", ".vert", ".glsl", ".png"};

/// What reads a config, and nothing of what a cell is made by.
constexpr std::string_view config_header = "experiments/study/config/config.h";

bool is_source(const fs::path& file) {
    return std::ranges::count(source_endings, file.extension().string()) > 0 &&
           !file.stem().string().ends_with("_benchmark");
}

std::vector<std::string> includes_of(const std::string& text) {
    static constexpr std::string_view include = "#include \"";
    std::vector<std::string> includes;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);)
        if (line.starts_with(include))
            includes.push_back(line.substr(include.size(), line.rfind('"') - include.size()));
    return includes;
}

/// The folder whose sources belong together; "" where each stands for itself.
std::string room_of(const std::string& path) {
    if (path.starts_with("experiments/") && !path.starts_with("experiments/gpu_costs/")) return "";
    return path.substr(0, path.rfind('/') + 1);
}

}  // namespace

std::vector<SourceFile> read_sources(const fs::path& root) {
    std::vector<SourceFile> sources;
    for (const std::string_view folder : source_folders)
        for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
            const fs::path inside = entry.path().lexically_relative(root);
            if (!entry.is_regular_file() || !is_source(inside) || inside.string().find("/page/") != std::string::npos)
                continue;
            const std::string text = read_text(entry.path());
            ContentHash hash;
            hash.add(text);
            const bool has_includes = inside.extension() != ".png";
            sources.push_back(
                {inside.string(), hash.hex(), has_includes ? includes_of(text) : std::vector<std::string>{}});
        }
    std::ranges::sort(sources, {}, &SourceFile::path);
    return sources;
}

std::string source_table(const std::vector<SourceFile>& sources) {
    std::string table;
    for (const SourceFile& source : sources) {
        table += source.path + " " + source.hash;
        for (const std::string& include : source.includes) table += " " + include;
        table += "\n";
    }
    return table;
}

std::vector<SourceFile> parse_source_table(std::string_view table) {
    std::vector<SourceFile> sources;
    std::istringstream lines{std::string(table)};
    for (std::string line; std::getline(lines, line);) {
        std::istringstream words(line);
        SourceFile source;
        words >> source.path >> source.hash;
        for (std::string include; words >> include;) source.includes.push_back(include);
        sources.push_back(std::move(source));
    }
    return sources;
}

SourceCode::SourceCode(std::vector<SourceFile> sources) {
    for (SourceFile& source : sources) {
        const std::string path = source.path;
        sources_.insert_or_assign(path, std::move(source));
    }
}

std::set<std::string> SourceCode::needed_by(const std::vector<std::string>& roots) const {
    std::set<std::string> needed, rooms;
    std::vector<std::string> open;
    const auto open_folder = [&](const std::string& folder, bool with_those_in_it) {
        const size_t before = open.size();
        for (auto at = sources_.lower_bound(folder); at != sources_.end() && at->first.starts_with(folder); ++at)
            if (with_those_in_it || at->first.find('/', folder.size()) == std::string::npos) open.push_back(at->first);
        return open.size() > before;
    };
    for (const std::string& root : roots) {
        if (root.ends_with('/') ? open_folder(root, true) : sources_.contains(root)) {
            if (!root.ends_with('/')) open.push_back(root);
            continue;
        }
        fail("no source of ssrlab is called '", root, "'");
    }
    while (!open.empty()) {
        const std::string path = open.back();
        open.pop_back();
        if (!needed.insert(path).second) continue;
        for (const std::string& include : sources_.at(path).includes)
            for (const char* shader_root : {"", "variants/", "core/shaders/"})
                if (sources_.contains(shader_root + include)) open.push_back(shader_root + include);
        const std::string room = room_of(path);
        if (!room.empty() && rooms.insert(room).second) open_folder(room, false);
        if (path.starts_with("core/") && rooms.insert("core/shaders/").second) open_folder("core/shaders/", true);
        if (path.starts_with("experiments/") && path.ends_with(".h") && path != config_header)
            if (const std::string source = path.substr(0, path.size() - 1) + "cpp"; sources_.contains(source))
                open.push_back(source);
    }
    return needed;
}

std::string SourceCode::hash_of(const std::vector<std::string>& roots) const {
    ContentHash hash;
    for (const std::string& path : needed_by(roots)) hash.add(path), hash.add(sources_.at(path).hash);
    return hash.hex();
}
