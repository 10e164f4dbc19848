#pragma once
#include "core/gpu/pipelines/shader.h"

#include <cstdint>
#include <optional>

/// Results of compile(), kept between processes: files in $SSRLAB_SHADER_CACHE, else in `shaders/` of the cache folder
/// (core/cache_folder.h). They may be deleted at any time. A broken file counts as missing; a shader that cannot be
/// written is compiled again.
class ShaderCache {
public:
    static constexpr uintmax_t most_bytes = 256 << 20;

    /// The name of a kept shader: the hash of `sources` (all that its compiler gets), of the compilers' versions and of
    /// the code between them.
    static std::string key_of(const std::vector<std::string>& sources);

    static std::optional<Shader> find(const std::string& key);
    static void keep(const std::string& key, const Shader& shader);

    /// If the files take more than most_bytes, deletes the oldest until half of most_bytes is left. keep() does so once
    /// per process.
    static void make_room();
};
