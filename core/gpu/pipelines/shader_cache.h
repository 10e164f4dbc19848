#pragma once
#include "core/gpu/pipelines/shader.h"

#include <cstdint>
#include <optional>

/// What compile() made of shaders, kept between processes: most of them compile what others have compiled. In files of
/// $SSRLAB_SHADER_CACHE, else of `shaders/` of the cache folder (core/cache_folder.h), which may be deleted at any
/// time. One that is broken is not there, and what cannot be written is compiled again.
class ShaderCache {
public:
    static constexpr uintmax_t most_bytes = 256 << 20;

    /// The name under which a shader is kept: the hash of `sources`, all that its compiler is given, of the compilers'
    /// versions and of the code between.
    static std::string key_of(const std::vector<std::string>& sources);

    static std::optional<Shader> find(const std::string& key);
    static void keep(const std::string& key, const Shader& shader);

    /// If shaders take more than most_bytes, deletes those that were written first until half of that is left. keep()
    /// does so once in a process.
    static void make_room();
};
