#pragma once
#include "core/exr/exr.h"
#include "core/gbuffer/gbuffer_file.h"

#include <set>
#include <span>

/// One layer of gbuffer.exr: some consecutive channels of one image of the G-buffer.
struct GBufferLayer {
    const char *name, *channels;
    HostImage HostGBuffer::*image;
    unsigned first_channel, image_channels;
    const char *meaning, *if_absent;      ///< `if_absent`: a sentence on what is taken instead; "" of required layers
    PixelType type = PixelType::float32;  ///< that ssrlab writes

    bool is_required() const { return *if_absent == 0; }
    unsigned count() const { return unsigned(std::char_traits<char>::length(channels)); }
};
std::span<const GBufferLayer> gbuffer_layers();

/// `count` channels of one image into another of the same extent.
void copy_channels(const HostImage& from, unsigned from_channel, HostImage& to, unsigned to_channel, unsigned count);

struct FoundLayers {
    std::set<std::string> names;
    std::vector<std::string> notes;  ///< one sentence each: unused content, and values that a compression changed
    MemoryShare memory;
};

/// Reads the layers of `file`, and no other channels, into the images of `gbuffer`, whose camera says their extent.
/// Channels are chosen by name. Vectors are X Y Z, or R G B as picture programs name them; single values have the
/// letter in gbuffer_file.h, or the layer's only channel. The picture is the display window; pixels outside the data
/// window of `depth` are background. Colours are converted to linear Rec. 709. Fails with Error, naming file and layer,
/// if a required layer or channel is missing, the extent differs, or material numbers are above 2^24.
FoundLayers read_gbuffer_layers(const std::filesystem::path& file, HostGBuffer& gbuffer);
