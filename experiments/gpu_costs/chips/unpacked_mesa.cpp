#include "experiments/gpu_costs/chips/unpacked_mesa.h"

#include "core/error.h"

#include <algorithm>
#include <cstdlib>
#include <vector>

namespace fs = std::filesystem;

namespace {

constexpr const char* file_name = "libvulkan_radeon.so";

template <class... Args>
[[noreturn]] void refuse(const fs::path& mesa, const Args&... why) {
    fail("the folder of --mesa or SSRLAB_MESA, '", mesa.string(), "', ", why...,
         "; `experiments/newer_mesa.sh FOLDER` fills an empty one with Mesa's driver");
}

}  // namespace

fs::path chosen_mesa() {
    const char* const folder = std::getenv("SSRLAB_MESA");
    return folder ? folder : "";
}

fs::path radv_in(const fs::path& mesa) {
    if (mesa.empty()) return {};
    std::error_code error;
    if (!fs::exists(mesa, error)) refuse(mesa, "does not exist");
    if (!fs::is_directory(mesa, error)) refuse(mesa, "is no folder");
    std::vector<fs::path> folders = {mesa / "usr/lib"};  // and those of an architecture: x86_64-linux-gnu
    for (const auto& entry : fs::directory_iterator(folders.front(), error)) folders.push_back(entry.path());
    std::ranges::sort(folders);
    for (const fs::path& folder : folders)
        if (fs::is_regular_file(folder / file_name, error)) return fs::absolute(folder / file_name);
    refuse(mesa, "has no ", file_name, " in usr/lib");
}
