#pragma once
#include "core/host_image.h"

#include <filesystem>
#include <string>
#include <vector>

/// Reads a Radiance picture (.hdr, .pic, .rgbe; "Radiance File Formats", the picture file format) as linear Rec. 709
/// radiance, RGB, whatever its orientation: flat, of the old or the new run-length encoding. A mantissa m with the
/// exponent e is m 2^(e - 136), as OpenImageIO, Blender and most programs have it; Radiance itself adds half a step,
/// 0.2 to 0.4 %. What EXPOSURE and COLORCORR say was multiplied in is divided out. Colours of other PRIMARIES and of
/// XYZE are converted. `notes` gets a sentence for each of these. Fails with Error if the file is missing, cut or none,
/// or if its header announces more than may be read (reading_limits.h).
HostImage read_radiance_hdr(const std::filesystem::path& file, std::vector<std::string>& notes);
