#pragma once
#include "experiments/study/measuring/shot_truth.h"
#include "experiments/study/spent_time.h"

struct PointSettings {
    std::filesystem::path out;  ///< the results folder, for images
    std::string image_suffix;   ///< in the names of the cell's images, which other cells would name alike
    bool keep_all = false;
    std::function<void(double)> report;  ///< gets the share done
    SpentTime& spent;                    ///< counts what is waited for files of images, as "images"
};

/// Plays a shot with one technique point and all its seeds: the heart of ssrlab. Every seed starts from a fresh state,
/// with images and histories of its own. Seeds are played one after another; where the store cannot keep
/// all frames, several advance side by side, so that fewer are drawn again.
Cell render_point(Device& device, const Shot& shot, const ShotTruth& truth, FrameStore& store, const Config& config,
                  const PointConfig& technique, const PointSettings& settings);
