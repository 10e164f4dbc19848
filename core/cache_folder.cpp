#include "core/cache_folder.h"

#include <cstdlib>

namespace fs = std::filesystem;

fs::path default_cache_folder() {
    const auto variable = [](const char* name) -> std::string {
        const char* value = std::getenv(name);
        return value ? value : "";
    };
    if (const std::string folder = variable("SSRLAB_CACHE"); !folder.empty()) return folder;
    if (const std::string folder = variable("XDG_CACHE_HOME"); !folder.empty()) return fs::path(folder) / "ssrlab";
    if (const std::string home = variable("HOME"); !home.empty()) return fs::path(home) / ".cache" / "ssrlab";
    return fs::temp_directory_path() / "ssrlab";
}
