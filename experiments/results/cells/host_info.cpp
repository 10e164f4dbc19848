#include "experiments/results/cells/host_info.h"

#include "core/files.h"
#include "core/json.h"
#include "core/own_files.h"
#include "core/reading_limits.h"
#include "metrics/estimators.h"

#include <sys/utsname.h>
#include <algorithm>
#include <cmath>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <map>
#include <string_view>
#include <thread>
#include <vector>

namespace fs = std::filesystem;

extern const std::string_view compiled_source_table;  // written by source_table, see CMakeLists.txt

namespace {

/// Shaders, what they include, and the tables of techniques, in an order of their own.
std::vector<fs::path> files_read_at_run_time() {
    const std::vector<std::string> extensions = {".comp", ".frag", ".vert", ".glsl", ".h", ".png"};
    std::vector<fs::path> files;
    for (const char* folder : {"core", "variants"})
        for (const auto& entry : fs::recursive_directory_iterator(own_files() / folder))
            if (std::ranges::count(extensions, entry.path().extension().string()) > 0) files.push_back(entry.path());
    std::ranges::sort(files);
    return files;
}

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
    return {{"name", kernel.nodename},
            {"cpu", proc_value("/proc/cpuinfo", "model name")},
            {"cores", std::thread::hardware_concurrency()},
            {"memory_gib", std::round(double(machine_memory()) / double(1 << 30) * 10.0) / 10.0},
            {"kernel", std::string(kernel.sysname) + " " + kernel.release}};
}

fs::path this_program() { return fs::read_symlink("/proc/self/exe"); }

nlohmann::json build_info() {
    nlohmann::json build = {{"commit", ""}, {"dirty", false}};
    const fs::path file = built_files() / "build_commit.json";
    const std::string code = code_hash();
    if (fs::exists(file)) {
        build = read_json(file);
        if (build.value("code", "") != code) build["dirty"] = true;
    }
    return {
        {"version", SSRLAB_VERSION},   {"commit", build.at("commit")}, {"dirty", build.at("dirty")},     {"code", code},
        {"compiler", SSRLAB_COMPILER}, {"build", SSRLAB_BUILD_TYPE},   {"estimators", estimator_version}};
}

std::string code_hash() {
    ContentHash hash;
    hash.add(read_text("/proc/self/exe"));
    for (const fs::path& file : files_read_at_run_time()) hash.add(read_text(file));
    return hash.hex();
}

std::vector<SourceFile> present_sources() {
    std::map<std::string, SourceFile> sources;
    for (SourceFile& source : parse_source_table(compiled_source_table))
        if (source.path.ends_with(".cpp") || source.path.ends_with(".h"))
            sources.insert_or_assign(source.path, std::move(source));
    for (SourceFile& source : read_sources(own_files())) {
        if (source.path.ends_with(".cpp")) continue;
        const auto compiled = sources.find(source.path);
        const bool is_only_read = !source.path.ends_with(".h");
        if (is_only_read)
            sources.insert_or_assign(source.path, std::move(source));
        else if (compiled != sources.end() && !source.path.starts_with("experiments/"))
            compiled->second.hash += source.hash;  // C++ saw it then, and shaders see it now
    }
    std::vector<SourceFile> list;
    for (auto& [path, source] : sources) list.push_back(std::move(source));
    return list;
}

std::string time_stamp() {
    const std::time_t now = std::time(nullptr);
    char text[32];
    std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", std::gmtime(&now));
    return text;
}
