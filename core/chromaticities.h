#pragma once
#include <glm/glm.hpp>
#include <optional>
#include <string>

/// CIE 1931 xy of the primaries and the white of a colour space.
struct Chromaticities {
    glm::dvec2 red, green, blue, white;
};

/// ITU-R BT.709, with D65: the space of all colours in ssrlab.
inline constexpr Chromaticities rec709_chromaticities{{0.64, 0.33}, {0.30, 0.60}, {0.15, 0.06}, {0.3127, 0.3290}};

/// Whether each coordinate is within 0.001 of Rec. 709's: files have rounded numbers, and no other space is so near.
bool is_rec709(const Chromaticities& space);

/// The name of a space in use, such as "Rec. 2020" or "ACES AP0", else "other primaries".
std::string name_of(const Chromaticities& space);

/// Converts linear colours of the space, whose white has Y = 1, to CIE XYZ (SMPTE RP 177-1993). None if the primaries
/// lie on a line, the white's y is 0, or the white is outside of the triangle of the primaries.
std::optional<glm::dmat3> xyz_from(const Chromaticities& space);

/// Converts linear colours of the space to linear Rec. 709. Bradford's transform keeps white (ICC.1:2022, annex E), as
/// in OpenEXR's ImfAcesFile.h. The space CIE XYZ, whose primaries are the axes, is not adapted: tristimulus values have
/// no white. Colours outside Rec. 709 get parts below 0 or above 1. None where xyz_from() gives none.
std::optional<glm::dmat3> rec709_from(const Chromaticities& space);
