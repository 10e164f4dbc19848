#pragma once
#include "core/scene/camera.h"

#include <filesystem>

/// camera.json of a saved G-buffer; see gbuffer_file.h for its keys.
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
