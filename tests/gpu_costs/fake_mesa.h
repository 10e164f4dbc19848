#pragma once
#include "core/error.h"
#include "core/files.h"
#include "experiments/gpu_costs/chips/unpacked_mesa.h"

/// Unpacks the installed radv into `folder` as Mesa 99: a driver of another version that knows the same chips. False
/// where none is installed.
inline bool unpack_fake_mesa(const std::filesystem::path& folder) {
    std::string bytes;
    try {
        bytes = read_text(radv_in("/"));
    } catch (const Error&) {
        return false;
    }
    const size_t at = bytes.find("Mesa 2");
    if (at == bytes.npos) return false;
    write_text(folder / "usr/lib/libvulkan_radeon.so", bytes.replace(at, 7, "Mesa 99"));
    return true;
}
