#pragma once
#include "core/scene/camera.h"

#include <filesystem>
#include <span>

/// A key of camera.json, for readers.
struct CameraFileKey {
    const char *name, *values;
    const char* initial;  ///< "": required
    const char* meaning;
};
/// All keys that read_camera() knows, in the order in which a writer meets them.
std::span<const CameraFileKey> camera_file_keys();

/// camera.json of a saved G-buffer.
struct CameraFile {
    CameraData camera{};
    DepthFormat depth_format = DepthFormat::d32f;
    float exposure_ev = 0;
};

/// Every number reads back as the same bits. Writes atomically and fails as write_text().
void write_camera(const std::filesystem::path& file, const CameraFile& camera);
/// Fails with Error, which names file and key, if a key is missing or unknown, or its value is no number or out of
/// range.
CameraFile read_camera(const std::filesystem::path& file);
