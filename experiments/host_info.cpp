#include "experiments/host_info.h"

#include "core/files.h"
#include "core/json.h"

#include <sys/utsname.h>
#include <unistd.h>
#include <algorithm>
#include <cmath>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <thread>
#include <vector>

namespace {

/// The value behind "key   : value" in a file of /proc.
std::string proc_value(const char* file, const std::string& key) {
    std::ifstream in(file);
    for (std::string line; std::getline(in, line);)
        if (line.starts_with(key))
            if (const size_t colon = line.find(':'); colon != std::string::npos)
                return line.substr(line.find_first_not_of(" \t", colon + 1));
    return "unknown";
}

}  // namespace

nlohmann::json host_info() {
    utsname kernel{};
    uname(&kernel);
    const double bytes = double(sysconf(_SC_PHYS_PAGES)) * double(sysconf(_SC_PAGE_SIZE));
    return {{"cpu", proc_value("/proc/cpuinfo", "model name")},
            {"cores", std::thread::hardware_concurrency()},
            {"memory_gib", std::round(bytes / double(1 << 30) * 10.0) / 10.0},
            {"kernel", std::string(kernel.sysname) + " " + kernel.release}};
}

nlohmann::json build_info() {
    nlohmann::json build = {{"commit", ""}, {"dirty", false}};
    const std::filesystem::path file =
        std::filesystem::read_symlink("/proc/self/exe").parent_path() / "build_commit.json";
    if (std::filesystem::exists(file)) build = read_json(file);
    return {{"version", SSRLAB_VERSION},
            {"commit", build.at("commit")},
            {"dirty", build.at("dirty")},
            {"compiler", SSRLAB_COMPILER},
            {"build", SSRLAB_BUILD_TYPE}};
}

std::string code_hash() {
    namespace fs = std::filesystem;
    ContentHash hash;
    hash.add(read_text("/proc/self/exe"));
    std::vector<fs::path> shaders;
    for (const char* folder : {"core", "variants"})
        for (const auto& entry : fs::recursive_directory_iterator(fs::path(SSRLAB_SOURCE_DIR) / folder)) {
            const std::string extension = entry.path().extension();
            const bool is_shader =
                std::ranges::any_of(std::vector<std::string>{".comp", ".frag", ".vert", ".glsl", ".h"},
                                    [&](const std::string& e) { return e == extension; });
            if (is_shader) shaders.push_back(entry.path());
        }
    std::ranges::sort(shaders);
    for (const fs::path& shader : shaders) hash.add(read_text(shader));
    return hash.hex();
}

std::string time_stamp() {
    const std::time_t now = std::time(nullptr);
    char text[32];
    std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", std::gmtime(&now));
    return text;
}
