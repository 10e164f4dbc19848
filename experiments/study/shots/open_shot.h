#pragma once
#include "core/gpu/device.h"
#include "experiments/results/cells/cell.h"
#include "experiments/study/measuring/frames/capture.h"
#include "experiments/study/measuring/shot_truth.h"

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

/// Settings for opening a shot, besides its config.
struct OpenShotSettings {
    std::filesystem::path out;                       ///< results folder, where images go
    std::filesystem::path cache;                     ///< of references
    std::vector<std::filesystem::path> search_path;  ///< of scenes
    bool keep_all = false;
    std::function<void(const std::string&)> say;                        ///< gets sentences for the user
    std::function<void(double share, const std::string& what)> report;  ///< of references that are rendered
};

/// An open shot: everything that its cells are made from.
struct OpenShot {
    Shot shot;
    std::unique_ptr<Capture> capture;  ///< null: the shot is of a scene
    std::optional<Environment> probe;  ///< fallback of reflections, if the shot asks for one; outlives `source`
    std::unique_ptr<FrameSource> source;
    std::unique_ptr<FrameStore> store;
    ShotTruth truth;
    bool has_rendered_references = false;  ///< false: all were in the cache, or there are none
    double opening_seconds = 0;
    /// Manifest entry of the shot, complete once its truth is known.
    nlohmann::json entry = nlohmann::json::object();
    nlohmann::json images = nlohmann::json::array();  ///< manifest entries of images of the truth and of surfaces
};

/// Loads a scene or capture, draws its G-buffers, and renders its references or takes them from the cache.
std::unique_ptr<OpenShot> open_shot(Device& device, const ShotConfig& shot, const Config& config,
                                    const OpenShotSettings& settings);

/// The cell of a shot's references: all that is kept of it besides results of techniques.
Cell references_cell(const OpenShot& run);
