#pragma once
#include "core/host_image.h"

#include <filesystem>
#include <string>
#include <vector>

/// Reads a Radiance picture (.hdr, .pic, .rgbe; "Radiance File Formats", the picture file format) as linear Rec. 709
/// radiance, RGB, in any orientation: flat, or of the old or new run-length encoding. A mantissa m with the exponent e
/// is m 2^(e - 136), as in OpenImageIO, Blender and most programs. Radiance itself adds half a step, 0.2 to 0.4 %.
/// Factors of EXPOSURE and COLORCORR are divided out. Colours of other PRIMARIES and of XYZE are converted. `notes`
/// gets a sentence for each of these. Fails with Error if the file is missing, cut or no such picture, or if its header
/// announces more than may be read (reading_limits.h).
HostImage read_radiance_hdr(const std::filesystem::path& file, std::vector<std::string>& notes);
