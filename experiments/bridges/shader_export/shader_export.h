#pragma once
#include "experiments/study/config/config.h"

#include <filesystem>

class Device;

/// Which technique is exported, and for which screen.
struct ExportRequest {
    PointConfig point;
    glm::uvec2 screen{480, 270};  ///< pixels, of the numbers in the description
    std::vector<std::filesystem::path> scene_path;
};

/// Fails with Error unless the folder is missing, empty, or was made by export_shaders().
void check_export_folder(const std::filesystem::path& folder);

/// Writes one shader for each pass of the technique, passes.json and README.md, which describe them, and the licence.
/// Removes the files of an earlier export from the folder. Returns the number of shaders. Fails with Error as
/// check_export_folder() and frame_passes() do, and with MachineError if the folder cannot be written.
size_t export_shaders(Device& device, const ExportRequest& request, const std::filesystem::path& folder);
