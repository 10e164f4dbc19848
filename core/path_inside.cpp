#include "core/path_inside.h"

#include "core/error.h"
#include "core/near_miss.h"

#include <algorithm>

namespace fs = std::filesystem;

fs::path path_inside(const fs::path& folder, const std::string& name, const std::string& where) {
    const std::string before = where.empty() ? "" : where + ": ";
    const fs::path inside(name);
    if (name.empty() || inside.is_absolute() || name.find('\0') != std::string::npos ||
        std::ranges::count(inside, fs::path("..")) > 0)
        fail(before, "'", shortened(name), "' is no path below ", folder.string(),
             ": such a name is relative and has no '..'");
    fs::path path = folder;
    for (const fs::path& part : inside) {
        path /= part;
        std::error_code error;
        if (fs::symlink_status(path, error).type() == fs::file_type::symlink)
            fail(before, path.string(), " is a symbolic link, which may lead out of ", folder.string(),
                 " and is not followed; put what it points to in its place, or remove it");
    }
    return path;
}
