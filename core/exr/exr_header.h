#pragma once
#include "core/chromaticities.h"

#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <map>
#include <optional>
#include <string>
#include <vector>

/// How the values of a channel are stored in a file.
enum class PixelType { half, float32, uint32 };

struct ExrChannel {
    std::string name;
    PixelType type = PixelType::float32;
    glm::ivec2 sampling{1, 1};  ///< pixels in x and in y for which there is one value
};

/// Pixels from `min` to `max`, which is inside; y points down.
struct ExrWindow {
    glm::ivec2 min{0}, max{0};

    glm::dvec2 extent() const { return glm::dvec2(max) - glm::dvec2(min) + 1.0; }  ///< pixels
    bool operator==(const ExrWindow&) const = default;
};
/// "0..31 x 0..17"
std::string shown(const ExrWindow& window);

/// One image of a file. Several parts share the display window and the chromaticities.
struct ExrPart {
    std::string name;  ///< "" where the file does not say
    std::string view;  ///< view of channels without a layer's name: the attribute `view`, or the first of `multiView`
    bool is_deep = false;  ///< pixels hold lists of samples
    std::vector<ExrChannel> channels;
    ExrWindow data, display;    ///< stored pixels; pixels of the picture
    glm::dvec2 tile{0, 0};      ///< pixels; 0: scan lines
    unsigned compression = 0;   ///< as the file numbers it
    double unknown_blocks = 0;  ///< number of blocks that a part of unknown type declares
    std::optional<Chromaticities> chromaticities;
    std::map<std::string, std::string> texts;  ///< attributes that are strings

    double block_lines() const;  ///< how many rows are compressed together
    double blocks() const;       ///< number of blocks; of tiles, those in full resolution
    const char* compression_name() const;
    /// Whether the compression changes the channel's values. DWA changes colours and luminance, known by their letters;
    /// B44 changes halves; PXR24 changes floats (openexr.com, "Technical Introduction", "Data Compression").
    bool is_lossy(const ExrChannel& channel) const;
    /// What the compression does to these channels: "rounds ...". "" for one that is_lossy() for no channel.
    const char* loss() const;
};

struct ExrHeader {
    std::vector<ExrPart> parts;  ///< one at least
    bool has_part_flag = false;  ///< written as a file of several parts, even of one
};

/// Reads the header of an OpenEXR file, but no pixels (openexr.com, "OpenEXR File Layout"). Uses no more memory than
/// the file has bytes. Fails with Error if the file is missing or no OpenEXR file, or if its header is truncated or
/// malformed: OpenEXR might take any bytes for a length.
ExrHeader read_exr_header(const std::filesystem::path& file);
