#pragma once
#include "core/exr/exr_header.h"
#include "core/host_image.h"
#include "core/reading_limits.h"

#include <array>
#include <span>

/// Channels of one part that are read together, and what is read: the picture, which is the display window. What the
/// data window does not hold of it is 0 (OpenEXR, "Technical Introduction", "Display Window and Data Window").
struct ExrPlanes {
    size_t part = 0;
    std::vector<size_t> channels;  ///< indices into ExrPart::channels, in the order in which `image` has them

    HostImage image = {};
    /// As `image`, of channels that are stored as integers, which float32 holds up to 2^24 alone; 0 of other channels.
    /// Empty where there are no integers.
    std::vector<uint32_t> integers = {};
};

/// Fills the images of all `planes`, and decodes nothing else; sets their memory aside before. Fails with Error where a
/// part is deep or a channel is subsampled, where the file is truncated or malformed, or where it announces more than
/// may be read (reading_limits.h).
MemoryShare read_planes(const std::filesystem::path& file, const ExrHeader& header, std::span<ExrPlanes> planes);

/// Fails with Error where an integer of the planes is not what float32 has in its place: two above 2^24 may become one.
void refuse_rounding(const std::filesystem::path& file, const ExrHeader& header, const ExrPlanes& planes);

/// Linear RGB, in the file's primaries, of the channels of `part` that are Y, RY and BY. Subsampled chroma is read in
/// the precision of half floats. Fails as read_planes(), and where subsampled channels are not in the first part.
HostImage read_luminance_chroma(const std::filesystem::path& file, const ExrHeader& header, size_t part,
                                const std::array<size_t, 3>& channels, MemoryShare& memory);
