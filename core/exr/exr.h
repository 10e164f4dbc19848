#pragma once
#include "core/exr/exr_header.h"
#include "core/host_image.h"
#include "core/reading_limits.h"

#include <filesystem>
#include <map>
#include <string>
#include <vector>

struct Layer {
    std::string name;           ///< "" is the default layer, whose channels carry no prefix
    std::string channel_names;  ///< one letter per channel of `image`: "RGB", "RGBA", "XYZ", "XY", "Y", "Z"
    HostImage image;
    PixelType type = PixelType::float32;  ///< in the file; in memory values are float32, which holds integers to 2^24
};

/// A multi-layer OpenEXR image: channels are named "layer.X". Attributes are strings in the header.
struct LayeredImage {
    std::vector<Layer> layers;  ///< all of one extent
    std::map<std::string, std::string> attributes;
    MemoryShare memory = {};  ///< set aside for an image that was read

    const Layer* find(const std::string& name) const;  ///< nullptr if there is none of that name
};

/// Writes scan lines, ZIP-compressed, to a temporary name beside `file` and renames it, so a killed run leaves no half
/// file. Fails with MachineError if the disk is full or the folder cannot be written.
void write_exr(const std::filesystem::path& file, const LayeredImage& image);

/// Reads all layers of all parts (core/exr/exr_layers.h). Channels come in the order RGBA, XYZ, else alphabetical. The
/// images cover the display window, with 0 outside the data window. Fails with Error if the file is missing, truncated
/// or no OpenEXR file, or if its header announces more than may be read (reading_limits.h). Also fails on deep or
/// subsampled channels, and on larger integers than float32 holds.
LayeredImage read_exr(const std::filesystem::path& file);

/// One RGB image in the default layer.
void write_exr(const std::filesystem::path& file, const HostImage& rgb, PixelType type = PixelType::float32);

/// The colours of a file's `layer`, as read_exr_picture() of core/exr/exr_picture.h, without its notes.
HostImage read_exr_rgb(const std::filesystem::path& file, const std::string& layer = "");
