#pragma once
#include "core/decoded_image.h"

#include <array>
#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <span>
#include <string>

/// How the codes of a PNG become linear Rec. 709.
struct PngColors {
    /// None where they are sRGB codes, which need nothing. Of a row: as many colours as codes (RGB, in [0, 1]).
    std::function<void(std::span<glm::vec3>)> to_linear;
    std::string note;  ///< what that converts, or why it cannot; "" of sRGB
};

/// What the chunks before the pixels say, in the order of PNG (third edition), section 4.3: cICP, iCCP, sRGB, gAMA with
/// cHRM. gAMA of 1/2.2 within 1 % is sRGB: writers of sRGB give that number to readers that know no other (section
/// 11.3.2.5). Without cHRM primaries are Rec. 709's, without gAMA the curve is sRGB's. `file`: all of a PNG. Fails with
/// Error, which begins with `what`, where codes are no display codes of one meaning (PQ, HLG), or a space is not known.
PngColors png_colors(const EncodedImage& file);
