#pragma once
#include "experiments/study/config/config.h"

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

class Device;

/// A technique in some frames of a shot, for a page that does its passes again in a browser.
struct RecordSettings {
    ShotConfig shot;           ///< frames in a row, each rendered once
    PointConfig point;         ///< with one seed
    unsigned samples = 256;    ///< of the truth, per pixel
    bool has_results = false;  ///< also what the Vulkan device rendered, so that the page can compare
    bool has_passes = false;   ///< also what each pass wrote there
    std::filesystem::path page;
    std::filesystem::path cache;                                        ///< of references
    std::vector<std::filesystem::path> search_path;                     ///< of scenes
    std::function<void(const std::string&)> say;                        ///< gets sentences for the user
    std::function<void(double share, const std::string& what)> report;  ///< of references that are rendered
};

struct RecordedPage {
    size_t bytes = 0;                  ///< of the page
    unsigned passes = 0;               ///< of the last frame
    std::vector<double> errors;        ///< of each frame, as the page states them
    std::vector<std::string> sliders;  ///< names of parameters that have one
};

/// Writes settings.page: one file that needs no other and no network. Fails with Error, before anything is rendered, if
/// the technique does what WebGL 2 cannot do, which names the pass; if scene or camera are unknown; or if the page
/// would be larger than browsers take.
RecordedPage record_page(Device& device, const RecordSettings& settings);
