#include "core/own_files.h"

#include "core/error.h"

namespace fs = std::filesystem;

namespace {

/// PREFIX/`inside`, or `otherwise` without an installation.
fs::path installed_or(const fs::path& inside, const fs::path& otherwise) {
    std::error_code error;
    const fs::path prefix = fs::read_symlink("/proc/self/exe", error).parent_path().parent_path();
    if (fs::is_directory(prefix / "share/ssrlab", error)) return prefix / inside;
    if (!fs::is_directory(otherwise, error))
        fail_machine("ssrlab's own files are neither in ", (prefix / "share/ssrlab").string(), " nor in ",
                     otherwise.string(), "; install ssrlab again: cmake --install BUILD_FOLDER");
    return otherwise;
}

}  // namespace

const fs::path& own_files() {
    static const fs::path folder = installed_or("share/ssrlab", SSRLAB_SOURCE_DIR);
    return folder;
}

const fs::path& built_files() {
    static const fs::path folder = installed_or("lib/ssrlab", SSRLAB_BUILD_DIR);
    return folder;
}
