#pragma once
#include "core/exr/exr_layers.h"
#include "core/host_image.h"
#include "core/reading_limits.h"

#include <filesystem>
#include <string>
#include <vector>

/// The colours that a file shows.
struct ExrPicture {
    HostImage rgb;  ///< the display window, linear Rec. 709
    std::vector<std::string>
        notes;  ///< one sentence each, which begins with the file: what was chosen, converted and lost
    MemoryShare memory;
};

/// What the colours of a file are made of.
struct ExrPictureSource {
    enum class Kind { rgb, luminance_chroma, vector, grey };  ///< vector: X Y Z, as they are
    ExrLayer layer;
    std::vector<ExrComponent> components;  ///< of the layer, in the order of R G B, Y RY BY or X Y Z; one of grey
    Kind kind = Kind::rgb;
};

/// The channels that read_exr_picture() makes its colours of, from the header alone. `notes` gets a sentence for each
/// choice, and one if the compression changed the colours. Fails with Error, as read_exr_picture() does, without such a
/// layer or such channels.
ExrPictureSource exr_picture_source(const std::filesystem::path& file, const ExrHeader& header,
                                    const std::string& layer, std::vector<std::string>& notes);

/// Reads the colours of `layer`: a layer, a part, a view or a channel. "" stands for the first of these that exists: R,
/// G and B (or Y, RY and BY) without a layer's name; the layer "image", as in references; the only layer with R, G and
/// B; a grey picture. A file whose only layer has no name has this layer under every name.
///
/// Channels are chosen by their names (exr_layers.h): R G B, or Y RY BY, or X Y Z as they are, or Y as grey, or the
/// only channel beside A as grey. R, G and B are converted to Rec. 709 from the primaries that `chromaticities` names.
/// The attributes `whiteLuminance` and `acesImageContainerFlag` are ignored: values stay relative, and ACES files name
/// their primaries as others do.
///
/// Another white than D65 is adapted to D65: see core/chromaticities.h.
///
/// Fails with Error, which lists the file's layers, if there is no such layer or none of these channels; if integers
/// are above what float32 holds (2^24); and as read_planes() of exr_pixels.h.
ExrPicture read_exr_picture(const std::filesystem::path& file, const std::string& layer = "");
