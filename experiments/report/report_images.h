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
