#include "core/gpu/pipelines/shader_cache.h"

#include "core/cache_folder.h"
#include "core/files.h"
#include "core/path_inside.h"

#include <glslang/build_info.h>
#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <spirv-tools/libspirv.hpp>

namespace fs = std::filesystem;
using nlohmann::json;

NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(ShaderInterface::Resource, name, binding, kind, is_vertex, type)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(ShaderInterface, resources, formatted_images, push_offsets, push_sizes, push_size,
                                   outputs, constants, local_size)
NLOHMANN_DEFINE_TYPE_NON_INTRUSIVE(Shader, spirv, interface)

namespace {

fs::path folder() {
    const char* const own = std::getenv("SSRLAB_SHADER_CACHE");
    return own && *own ? fs::path(own) : default_cache_folder() / "shaders";
}

std::string hash_of(std::string_view bytes) {
    ContentHash hash;
    hash.add(bytes);
    return hash.hex();
}

/// Whether the file can be one of ours: nothing else may be deleted.
bool is_key(const std::string& name) {
    return name.size() == hash_of("").size() &&
           std::ranges::all_of(name, [](unsigned char c) { return std::isxdigit(c) != 0; });
}

}  // namespace

std::string ShaderCache::key_of(const std::vector<std::string>& sources) {
    ContentHash hash;
    hash.add(SSRLAB_SHADER_CODE);
    for (const int part : {GLSLANG_VERSION_MAJOR, GLSLANG_VERSION_MINOR, GLSLANG_VERSION_PATCH}) hash.add(part);
    hash.add(spvSoftwareVersionDetailsString());
    for (const std::string& source : sources) hash.add(source);
    return hash.hex();
}

std::optional<Shader> ShaderCache::find(const std::string& key) {
    try {
        const fs::path file = path_inside(folder(), key);
        if (!fs::is_regular_file(file)) return {};
        const std::string text = read_text(file);
        const size_t hash_digits = hash_of("").size();
        if (text.size() < hash_digits) return {};
        const std::string_view content = std::string_view(text).substr(hash_digits);
        if (!text.starts_with(hash_of(content))) return {};
        return json::from_cbor(content).get<Shader>();
    } catch (const std::exception&) {  // of another layout, or deleted meanwhile
        return {};
    }
}

void ShaderCache::keep(const std::string& key, const Shader& shader) {
    std::string content;
    json::to_cbor(shader, content);
    try {
        static const bool is_first = (make_room(), true);
        (void)is_first;
        write_text(path_inside(folder(), key), hash_of(content) + content);
    } catch (const std::exception&) {  // read-only, or full
    }
}

void ShaderCache::make_room() {
    struct Kept {
        fs::file_time_type written;
        uintmax_t bytes;
        fs::path file;
    };
    std::vector<Kept> all;
    uintmax_t bytes = 0;
    std::error_code none;  // another process may delete, too
    for (const auto& entry : fs::directory_iterator(folder(), none)) {
        const uintmax_t size = entry.file_size(none);
        if (none || !is_key(entry.path().filename().string())) continue;
        all.push_back({entry.last_write_time(none), size, entry.path()});
        bytes += size;
    }
    if (bytes <= most_bytes) return;
    std::ranges::sort(all, {}, &Kept::written);
    for (const Kept& kept : all) {
        if (bytes <= most_bytes / 2) return;
        fs::remove(kept.file, none);
        bytes -= kept.bytes;
    }
}
