#pragma once
#include "core/decoded_image.h"
#include "core/host_image.h"

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

/// Writes an RGB image as 8-bit sRGB after multiplying by 2^exposure_ev and clamping to [0, 1]; NaN is written as
/// magenta, so that it is seen. Atomic as write_exr(), and fails as it does; with Error if the image has zero size.
void write_png(const std::filesystem::path& file, const HostImage& rgb, float exposure_ev = 0.0f);

/// A PNG in memory of unchanged codes: RGB or RGBA, row by row, of 8 bits, or of 16 in the machine's byte order. Fails
/// with MachineError.
std::vector<std::byte> encode_png(glm::uvec2 extent, unsigned channels, unsigned channel_bytes,
                                  std::span<const uint8_t> codes);

/// Reads any PNG as sRGB *codes* (not linear) of three channels in [0, 1]: v / 255 of 8 bits, v / 65535 of 16 bits. The
/// file's colour space comes from cICP, else iCCP, else sRGB, else gAMA and cHRM (PNG, third edition, section 4.3);
/// without them it is sRGB. Other spaces are converted; colours outside Rec. 709 then have codes outside [0, 1], which
/// linear_from_srgb() takes. Alpha is left out, as PNG's alpha is straight. `notes` gets a sentence, which begins with
/// the file, for each conversion and for alpha that is not opaque. Fails with Error if the file is missing, cut, broken
/// or no PNG, or if its header announces more than may be read (reading_limits.h). Also fails if its colours cannot be
/// converted (PQ, HLG).
HostImage read_png_codes(const std::filesystem::path& file, std::vector<std::string>& notes);

/// The same for a file of ssrlab's own.
HostImage read_png_codes(const std::filesystem::path& file);

/// See decode_image() of decoded_image.h. The codes have 8 or 16 bits. Colours are not converted, as glTF ignores the
/// file's colour space (glTF 2.0, section 3.8.3). Takes 4 bytes per pixel more, whatever size the data inflate to.
DecodedImage decode_png(const EncodedImage& image, unsigned longest_side);

/// IEC 61966-2-1, both ways; 0 and 1 are kept. Codes and light below 0 are mirrored, those above 1 follow the curve.
float srgb_from_linear(float linear);
float linear_from_srgb(float code);
double linear_from_srgb(double code);
