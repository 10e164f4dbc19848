#pragma once
#include "core/host_image.h"
#include "experiments/report/report_points.h"

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

/// An image as the report carries it.
struct ReportImage {
    std::string shot, variant, point, kind, target;
    unsigned seed = 0;
    unsigned width = 0, height = 0;
    unsigned reduction = 1;  ///< each value is the mean of reduction x reduction pixels of the file
    size_t clamped = 0;      ///< pixels with a finite value beyond the half-float range, shown as +-65504
    std::string data;        ///< see encode_halves(), in base64
};

struct ReportImages {
    std::vector<ReportImage> images;
    std::vector<std::string> notes;  ///< sentences about what was reduced or left out
};

/// The images that fit into `budget` bytes of text, from manifest.json's `images`: for each shot the references and the
/// first seed of each variant point but those in `left_out`; of target `image` first, `specular` and `incident` if
/// there is room. If not even the first fits, all are reduced to a half, a quarter, an eighth; if that is still too
/// much, the last variant points are left out. Fails with Error if a file that the manifest lists is missing or broken.
ReportImages report_images(const std::filesystem::path& folder, const nlohmann::json& manifest,
                           const PointSet& left_out, size_t budget);

/// IEEE half floats, planar R G B: the low bytes of all values, then the high bytes, each byte minus the one before it
/// (modulo 256, as neighbours are alike), in a zlib stream. Finite values beyond +-65504 are clamped and their pixels
/// counted.
std::vector<unsigned char> encode_halves(const HostImage& rgb, size_t& clamped);

std::string base64(const std::vector<unsigned char>& bytes);
