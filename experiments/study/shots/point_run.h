#pragma once
#include "experiments/results/cell.h"
#include "experiments/study/shots/shot_truth.h"
#include "experiments/study/spent_time.h"

struct PointRunSettings {
    std::filesystem::path out;  ///< the results folder, for images
    std::string image_suffix;   ///< tells the cell's images from those of other cells of the same names
    bool keep_all = false;
    std::function<void(double)> report;  ///< gets the share done
    SpentTime& spent;                    ///< counts what is waited for files of images, as "images"
};

/// Plays a shot with one variant point and all its seeds: the heart of ssrlab. Every seed starts from a fresh state,
/// with images and histories of its own. Seeds are played one after another; where the store cannot keep
/// all frames, several advance side by side, so that fewer are drawn again.
Cell run_point(Device& device, const Shot& shot, const ShotTruth& truth, FrameStore& store, const Config& config,
               const VariantConfig& variant, const PointRunSettings& settings);
