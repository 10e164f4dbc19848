#pragma once
#include "core/scene/camera.h"

#include <filesystem>

/// camera.json of a saved G-buffer; see gbuffer_file.h for its keys.
struct CameraFile {
    CameraData camera{};
    DepthFormat depth_format = DepthFormat::d32f;
    float exposure_ev = 0;
};

void write_camera(const std::filesystem::path& file, const CameraFile& camera);
CameraFile read_camera(const std::filesystem::path& file);
