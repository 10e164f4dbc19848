#pragma once
#include "core/host_image.h"

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

// How pages hold images and other bytes (page/images/packed.js).

/// Encodes RGB as IEEE halves, rounded to the first `significand_bits` of their 10, in these steps. Planes G, R - G, B
/// - G of the halves as ordered integers, shifted by the dropped bits. The prediction of the median edge detector
/// (LOCO-I, Weinberger et al. 2000) from neighbours is subtracted, modulo 65536. The sign moves to the lowest bit. All
/// low bytes, then all high bytes, form a zlib stream. Finite values beyond +-65504 are clamped; `clamped` counts their
/// pixels.
std::vector<unsigned char> encode_halves(const HostImage& rgb, size_t& clamped, unsigned significand_bits = 10);

/// Encodes the first channel in 8 bits, as a zlib stream: 0 to 254 for 0 to 1, 255 for non-finite values. Enough for
/// numbers read to two digits.
std::vector<unsigned char> encode_bytes(const HostImage& image);

/// Encodes an image of at most 256 colours as a zlib stream of one index for each pixel. `palette` gets the sRGB codes,
/// [r, g, b] of 0 to 255. Fails with Error if there are more colours.
std::vector<unsigned char> encode_palette(const HostImage& rgb, nlohmann::json& palette);

/// What repeats in bytes: whatever compresses texts, or what is left of good predictions.
enum class Redundancy { of_texts, of_predictions };

/// Compresses bytes to a zlib stream.
std::vector<unsigned char> compressed(const std::vector<unsigned char>& bytes,
                                      Redundancy redundancy = Redundancy::of_texts);

/// Base64 (RFC 4648) with padding.
std::string base64(const std::vector<unsigned char>& bytes);
