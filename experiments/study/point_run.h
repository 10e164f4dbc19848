#pragma once
#include "experiments/study/shot_truth.h"

struct PointRunSettings {
    std::filesystem::path out;  ///< the results folder, for images
    std::string image_suffix;   ///< tells the cell's images from those of other cells of the same names
    bool keep_all = false;
    std::function<void(double)> report;  ///< gets the share done
};

/// Plays a shot with one variant point and all its seeds: the heart of ssrlab. Every seed starts from a fresh state,
/// with images and histories of its own. Seeds advance side by side, as many as fit, so that a frame's G-buffer is
/// drawn once for all of them.
Cell run_point(Device& device, const Shot& shot, const ShotTruth& truth, FrameStore& store, const Config& config,
               const VariantConfig& variant, const PointRunSettings& settings);
