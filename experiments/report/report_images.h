#pragma once
#include "core/host_image.h"

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

/// The pictures of a report, for its page's viewer (page/images/packed.js).
struct ReportImages {
    /// One object for each image: shot, frame, technique, point, kind, target, seed, width, height, `format`; `palette`
    /// of images with a palette; `file`, relative to the folder, of images beside the page.
    nlohmann::json descriptions = nlohmann::json::array();
    std::vector<std::string> data;   ///< encoded images in base64, if they are in the page; else empty
    std::vector<std::string> notes;  ///< sentences about values that cannot be shown
};

inline constexpr const char* report_image_folder = "report_images";

/// The images that manifest.json lists, of the first seed of each point: results, references, confidence, verdicts of
/// rays, roughness of surfaces, and frames that are only played, with rounded values; where the study measures
/// cvvdp_0_5_6, a map of visible differences of each result, made here (kind "jod"). If all fit into `budget` bytes of
/// text they are returned. Else each is written as a script into report_images/, which a page can also load from disk.
/// Scripts of an earlier report stay if their images have not changed since, by size and time; others are removed. No
/// image is reduced or left out. Fails with Error if a listed file is missing or broken, or if images of a shot differ
/// in size.
ReportImages report_images(const std::filesystem::path& folder, const nlohmann::json& manifest, size_t budget);

/// report_images() with all images as texts.
ReportImages embedded_images(const std::filesystem::path& folder, const nlohmann::json& manifest);

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
