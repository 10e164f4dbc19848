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
    /// Converts a row of codes (RGB, in [0, 1]) in place. Empty for sRGB codes, which need no conversion.
    std::function<void(std::span<glm::vec3>)> to_linear;
    std::string note;  ///< what to_linear converts, or why it cannot; "" for sRGB
};

/// The colours that the chunks before the pixels declare, in the order of PNG (third edition), section 4.3: cICP, iCCP,
/// sRGB, gAMA with cHRM. gAMA of 1/2.2 within 1 % is sRGB: writers of sRGB give that number to simple readers (section
/// 11.3.2.5). Without cHRM primaries are Rec. 709's, without gAMA the curve is sRGB's. `file`: all of a PNG. Fails with
/// Error, which begins with `what`, if codes have no unique display colour (PQ, HLG), or the space is unknown.
PngColors png_colors(const EncodedImage& file);
