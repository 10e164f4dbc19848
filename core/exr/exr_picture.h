#pragma once
#include "core/exr/exr_layers.h"
#include "core/host_image.h"
#include "core/reading_limits.h"

#include <filesystem>
#include <string>
#include <vector>

/// The colours that a file shows.
struct ExrPicture {
    HostImage rgb;                   ///< the display window, linear Rec. 709
    std::vector<std::string> notes;  ///< one sentence each, which begins with the file: what was chosen and converted
    MemoryShare memory;
};

/// What the colours of a file are made of.
struct ExrPictureSource {
    enum class Kind { rgb, luminance_chroma, vector, grey };  ///< vector: X Y Z, as they are
    ExrLayer layer;
    std::vector<ExrComponent> components;  ///< of the layer, in the order of R G B, Y RY BY or X Y Z; one of grey
    Kind kind = Kind::rgb;
};

/// What read_exr_picture() makes its colours of, by the header alone. `notes` gets a sentence where a choice was made.
/// Fails with Error as it does where there is no such layer, or none of these channels.
ExrPictureSource exr_picture_source(const std::filesystem::path& file, const ExrHeader& header,
                                    const std::string& layer, std::vector<std::string>& notes);

/// Reads the colours of `layer`: a layer, a part, a view or a channel. Where that is "": R, G and B without a layer's
/// name, or Y, RY and BY; else the layer "image", as references call what the camera sees; else the only layer with
/// R, G and B; else a picture in grey. A file whose only layer has no name has it under every name.
///
/// Channels are chosen by their names (exr_layers.h): R G B, or Y RY BY, or X Y Z as they are, or Y as grey, or the
/// only channel beside A as grey. R, G and B are converted to Rec. 709 from the primaries that `chromaticities` names.
/// The attributes `whiteLuminance` and `acesImageContainerFlag` are left alone: values stay relative, and the primaries
/// of ACES files are named as of all others.
///
/// Primaries with another white than D65 are adapted to it: see core/chromaticities.h.
///
/// Fails with Error, with the layers that there are, if there is no such layer or none of these channels; if integers
/// are above what float32 holds (2^24); and as read_planes() of exr_pixels.h.
ExrPicture read_exr_picture(const std::filesystem::path& file, const std::string& layer = "");
