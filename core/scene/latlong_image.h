#pragma once
#include "core/host_image.h"

#include <filesystem>
#include <string>
#include <vector>

/// Reads an environment's image, in latitude and longitude (core/shared/environment.h), times `scale`. `notes` gets a
/// sentence for each conversion. Negative parts of colours outside Rec. 709 become 0. Fails with Error if the image is
/// not about twice as wide as high, with a command that converts other panoramas; if a value is not finite, too large,
/// or light is negative; and as the reader of the file does.
HostImage read_latlong(const std::filesystem::path& file, float scale, std::vector<std::string>& notes);
