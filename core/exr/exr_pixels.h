#pragma once
#include "core/exr/exr_header.h"
#include "core/host_image.h"
#include "core/reading_limits.h"

#include <array>
#include <span>

/// Channels of one part that are read together, and their values over the display window: 0 outside the data window
/// (OpenEXR, "Technical Introduction", "Display Window and Data Window").
struct ExrPlanes {
    size_t part = 0;
    std::vector<size_t> channels;  ///< indices into ExrPart::channels, in the order in which `image` has them

    HostImage image = {};
    /// Laid out as `image`: values of channels that are stored as integers, which float32 holds only up to 2^24; 0 for
    /// other channels. Empty without integers.
    std::vector<uint32_t> integers = {};
};

/// Fills the images of all `planes`, and decodes nothing else. Sets their memory aside first. Fails with Error if a
/// part is deep or a channel subsampled, if the file is truncated or malformed, or if it announces more than may be
/// read (reading_limits.h).
MemoryShare read_planes(const std::filesystem::path& file, const ExrHeader& header, std::span<ExrPlanes> planes);

/// Fails with Error if float32 rounds an integer of the planes: two integers above 2^24 may become equal.
void refuse_rounding(const std::filesystem::path& file, const ExrHeader& header, const ExrPlanes& planes);

/// Linear RGB, in the file's primaries, from the channels Y, RY and BY of `part`. Subsampled chroma has the precision
/// of half floats. Fails as read_planes(), and if subsampled channels are not in the first part.
HostImage read_luminance_chroma(const std::filesystem::path& file, const ExrHeader& header, size_t part,
                                const std::array<size_t, 3>& channels, MemoryShare& memory);
