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

/// A PNG in memory of codes as they are, RGB or RGBA, of 8 bits or of 16 in the machine's byte order, row by row. Fails
/// with MachineError.
std::vector<std::byte> encode_png(glm::uvec2 extent, unsigned channels, unsigned channel_bytes,
                                  std::span<const uint8_t> codes);

/// Reads a PNG of any kind as sRGB *codes* (not linear), three channels, with all bits that it has: 8-bit ones are v /
/// 255, 16-bit ones v / 65535, in [0, 1]. What the file says of its colour space counts as PNG (third edition),
/// section 4.3, has it: cICP, else iCCP, else sRGB, else gAMA and cHRM; a file without a word is sRGB. Another space is
/// converted, so that colours outside of Rec. 709 have codes outside of [0, 1] (linear_from_srgb() takes them). Alpha
/// is left out: PNG's is straight. `notes` gets a sentence, which begins with the file, for what was converted, and for
/// alpha that is not opaque. Fails with Error if the file is missing, cut, broken or no PNG, if its colours cannot be
/// converted (PQ, HLG), or if its header announces more than may be read (reading_limits.h).
HostImage read_png_codes(const std::filesystem::path& file, std::vector<std::string>& notes);

/// Those of a file of ssrlab's own.
HostImage read_png_codes(const std::filesystem::path& file);

/// See decode_image() of decoded_image.h. Of 8 bits, or 16. Colours are not converted: what the file says of them is
/// for glTF not to be used (glTF 2.0, section 3.8.3). Takes 4 bytes per pixel more, however much the data would inflate
/// to.
DecodedImage decode_png(const EncodedImage& image, unsigned longest_side);

/// IEC 61966-2-1, both ways; 0 and 1 are kept. Codes and light below 0 are mirrored, those above 1 follow the curve.
float srgb_from_linear(float linear);
float linear_from_srgb(float code);
double linear_from_srgb(double code);
