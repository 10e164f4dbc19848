#pragma once
#include "core/host_image.h"

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

/// The pictures of a report: what its page's viewer reads (page/images/packed.js).
struct ReportImages {
    /// One per image: shot, frame, technique, point, kind, target, seed, width, height, `format` and, of palettes,
    /// `palette`; `file`, relative to the folder, where the image lies beside the page.
    nlohmann::json descriptions = nlohmann::json::array();
    std::vector<std::string> data;   ///< the encoded images in base64, where they are a part of the page; else empty
    std::vector<std::string> notes;  ///< sentences about values that cannot be shown
};

inline constexpr const char* report_image_folder = "report_images";

/// The images that manifest.json lists, the first seed of each technique point: results, references, confidence,
/// verdicts of rays, the surface's roughness, and frames that are only played, whose values are rounded. Those of
/// `folder` that fit into `budget` bytes of text all together are returned; if they do not fit, each is written as a
/// script into report_images/ (made anew), which a page can load from a file, too. None is reduced in size or left out.
/// Fails with Error if a file that the manifest lists is missing or broken, or if images of a shot differ in size.
ReportImages report_images(const std::filesystem::path& folder, const nlohmann::json& manifest, size_t budget);

/// Those that `manifest` lists, all as texts. Fails as report_images().
ReportImages embedded_images(const std::filesystem::path& folder, const nlohmann::json& manifest);

/// RGB as IEEE half floats, rounded to the first `significand_bits` of their 10: planes G, R - G, B - G of the halves
/// as ordered integers, shifted by the bits that are left out; of each value what the median edge detector (LOCO-I,
/// Weinberger et al. 2000) foretells from its neighbours is taken off, modulo 65536, and the sign moved to the lowest
/// bit; low bytes of all, then high bytes, in a zlib stream. Finite values beyond +-65504 become that, and their pixels
/// are counted.
std::vector<unsigned char> encode_halves(const HostImage& rgb, size_t& clamped, unsigned significand_bits = 10);

/// The first channel in 8 bits each, in a zlib stream: 0 to 254 for 0 to 1, 255 for what is not finite. Enough for what
/// is read to two digits.
std::vector<unsigned char> encode_bytes(const HostImage& image);

/// An image of few colours: `palette` gets their sRGB codes, [r, g, b] of 0 to 255; the stream is zlib's of one index
/// per pixel. Fails with Error if there are more than 256 of them.
std::vector<unsigned char> encode_palette(const HostImage& rgb, nlohmann::json& palette);

/// A zlib stream.
std::vector<unsigned char> compressed(const std::vector<unsigned char>& bytes);

/// RFC 4648, with padding.
std::string base64(const std::vector<unsigned char>& bytes);
