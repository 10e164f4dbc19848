#pragma once
#include "core/host_image.h"
#include "core/reading_limits.h"

#include <filesystem>
#include <map>
#include <string>
#include <vector>

/// How the values of a layer are stored in the file. In memory they are always float32: half is exact in it, and uint
/// up to 2^24.
enum class PixelType { half, float32, uint32 };

struct Layer {
    std::string name;           ///< "" is the default layer, whose channels carry no prefix
    std::string channel_names;  ///< one letter per channel of `image`: "RGB", "RGBA", "XYZ", "XY", "Y", "Z"
    HostImage image;
    PixelType type = PixelType::float32;
};

/// A multi-layer OpenEXR image: channels are named "layer.X". Attributes are strings in the header.
struct LayeredImage {
    std::vector<Layer> layers;  ///< all of one extent
    std::map<std::string, std::string> attributes;
    MemoryShare memory = {};  ///< of an image that was read

    const Layer* find(const std::string& name) const;  ///< nullptr if there is none of that name
};

/// Writes scan lines, ZIP-compressed, to a temporary name beside `file` and renames it, so a killed run leaves no half
/// file. Fails with MachineError if the disk is full or the folder cannot be written.
void write_exr(const std::filesystem::path& file, const LayeredImage& image);

/// Reads all channels of a scan-line or tiled single-part file, each layer's in the order RGBA, XYZ, else alphabetical.
/// Fails with Error if the file is missing, truncated, of zero size or no OpenEXR file, or if its header announces more
/// than may be read (reading_limits.h).
LayeredImage read_exr(const std::filesystem::path& file);

/// One RGB image in the default layer.
void write_exr(const std::filesystem::path& file, const HostImage& rgb, PixelType type = PixelType::float32);

/// The RGB colour of a file's `layer`, or, if that is "", of its default layer, else its only one, else "image", as
/// references call what the camera sees. A file that has one layer without a name has it under every name. A single
/// channel is repeated three times. Fails, with the names that there are, if the file has no such layer.
HostImage read_exr_rgb(const std::filesystem::path& file, const std::string& layer = "");
