#pragma once
#include "core/host_image.h"

#include <filesystem>
#include <string>
#include <vector>

/// Reads linear radiance, RGB, from an OpenEXR or a Radiance file, as its bytes say. `layer`: of an OpenEXR file, see
/// read_exr_picture(). `notes` gets a sentence for each conversion. Fails with Error as the readers do
/// (exr/exr_picture.h, radiance_hdr.h). For another format the message has a command that converts it.
HostImage read_radiance(const std::filesystem::path& file, const std::string& layer, std::vector<std::string>& notes);
