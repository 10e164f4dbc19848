#include "experiments/results/cells/image_path.h"

#include "core/error.h"
#include "core/files.h"
#include "core/path_inside.h"

#include <ranges>

std::filesystem::path image_path(const std::filesystem::path& results, const std::string& name,
                                 const std::string& where) {
    const std::filesystem::path path = path_inside(results, name, where), inside = name;
    if (*inside.begin() != "images" || std::ranges::distance(inside) < 2)
        fail(where, where.empty() ? "'" : ": '", name, "' is not in images/, where ", results.string(),
             " has all of its images");
    return path;
}

std::string file_hash(const std::filesystem::path& file) {
    std::error_code error;
    if (!std::filesystem::is_regular_file(file, error)) return "";
    ContentHash hash;
    hash.add(read_text(file));
    return hash.hex();
}
