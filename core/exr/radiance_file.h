#pragma once
#include "core/host_image.h"

#include <filesystem>
#include <string>
#include <vector>

/// Reads linear radiance, RGB, from an OpenEXR or a Radiance file: which one its bytes say, not its name. `layer`: of
/// an OpenEXR file, as read_exr_picture() takes it. `notes` gets a sentence for each thing that was converted. Fails
/// with Error as the readers do (exr/exr_picture.h, radiance_hdr.h); of another format the message has a command that
/// converts it.
HostImage read_radiance(const std::filesystem::path& file, const std::string& layer, std::vector<std::string>& notes);
