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
    std::string view;  ///< of the channels without a layer's name: the attribute `view`, or the first of `multiView`
    bool is_deep = false;  ///< pixels hold lists of samples
    std::vector<ExrChannel> channels;
    ExrWindow data, display;    ///< which pixels are stored; which are the picture
    glm::dvec2 tile{0, 0};      ///< pixels; 0: scan lines
    unsigned compression = 0;   ///< as the file numbers it
    double unknown_blocks = 0;  ///< of a type of part that is not known: how many blocks it says to have
    std::optional<Chromaticities> chromaticities;
    std::map<std::string, std::string> texts;  ///< attributes that are strings

    double block_lines() const;  ///< how many rows are compressed together
    double blocks() const;       ///< how many there are, of tiles in full resolution
    const char* compression_name() const;
    /// Whether the compression changes the channel's values: DWA those of colours and luminance, by their letters, B44
    /// those of halves, PXR24 those of floats (openexr.com, "Technical Introduction", "Data Compression").
    bool is_lossy(const ExrChannel& channel) const;
};

struct ExrHeader {
    std::vector<ExrPart> parts;  ///< one at least
    bool has_part_flag = false;  ///< written as a file of several parts, even of one
};

/// Reads the header of an OpenEXR file, but no pixels (openexr.com, "OpenEXR File Layout"), and sets no memory aside
/// beyond what the file has bytes. Fails with Error if the file is missing, no OpenEXR file, or if its header is
/// truncated or malformed: what OpenEXR would then take for lengths could be anything.
ExrHeader read_exr_header(const std::filesystem::path& file);
