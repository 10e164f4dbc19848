#pragma once
#include "experiments/study/config/config.h"

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

class Device;

/// Settings of a recording: a technique in some frames of a shot, for a page that repeats its passes in a browser.
struct RecordSettings {
    ShotConfig shot;           ///< consecutive frames, each rendered once
    PointConfig point;         ///< with one seed
    unsigned samples = 256;    ///< samples per pixel of the truth
    bool has_results = false;  ///< also records the Vulkan device's results, for comparison in the page
    bool has_passes = false;   ///< also records what each pass wrote there
    std::filesystem::path page;
    std::filesystem::path cache;                                        ///< of references
    std::vector<std::filesystem::path> search_path;                     ///< of scenes
    std::function<void(const std::string&)> say;                        ///< gets sentences for the user
    std::function<void(double share, const std::string& what)> report;  ///< of references that are rendered
};

struct RecordedPage {
    size_t bytes = 0;                  ///< size of the page
    unsigned passes = 0;               ///< passes of the last frame
    std::vector<double> errors;        ///< error of each frame, as in the page
    std::vector<std::string> sliders;  ///< names of parameters with a slider
};

/// Writes settings.page: one file that needs no other file and no network. Fails with Error before anything is
/// rendered, if
///
/// - WebGL 2 cannot do a pass of the technique, which the message names,
/// - scene or camera is unknown, or
/// - the page would be larger than browsers accept.
RecordedPage record_page(Device& device, const RecordSettings& settings);
