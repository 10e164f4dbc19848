#pragma once
#include "experiments/study/measuring/shot_truth.h"
#include "experiments/study/spent_time.h"

struct PointSettings {
    std::filesystem::path out;  ///< the results folder, for images
    std::string image_suffix;   ///< part of the names of the cell's images, unlike that of other cells
    bool keep_all = false;
    std::function<void(double)> report;  ///< gets the share done
    SpentTime& spent;                    ///< counts time waiting for image files, as "images"
};

/// Plays a shot with one point and all its seeds: the heart of ssrlab. Every seed starts from a fresh state, with its
/// own images and histories. Seeds are played one after another; if the store cannot keep all frames, several advance
/// side by side, so that fewer frames are drawn again.
Cell render_point(Device& device, const Shot& shot, const ShotTruth& truth, FrameStore& store, const Config& config,
                  const PointConfig& technique, const PointSettings& settings);
