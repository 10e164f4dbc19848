#pragma once
#include "core/exr/exr_header.h"
#include "core/host_image.h"

/// Converts linear RGB of the part to linear Rec. 709 (core/chromaticities.h), where the attribute `chromaticities`
/// names other primaries. Returns a sentence about the conversion, which begins with the file; "" without conversion.
/// Fails with Error if the primaries span no colours.
std::string convert_to_rec709(const std::filesystem::path& file, const ExrPart& part, HostImage& rgb);

/// The shares of the part's R, G and B in the luminance of R = G = B = 1. Fails as convert_to_rec709().
glm::dvec3 luminance_weights(const std::filesystem::path& file, const ExrPart& part);
