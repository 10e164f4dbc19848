#pragma once
#include "experiments/study/measuring/shot_truth.h"

/// A technique point in an open shot; constant while it is rendered and measured.
struct PointInShot {
    const Shot& shot;
    const ShotTruth& truth;
    const Config& config;
    const PointConfig& technique;

    const FrameStep& last_step() const { return shot.steps.back(); }
    bool is_last(const FrameStep& step) const { return &step == &last_step(); }

    /// The common part of all rows of a seed's frame. `frame`: its number, or over_frames.
    ResultRow row(const std::string& frame, unsigned seed) const {
        return {.shot = shot.name(),
                .scene = shot.scene.name,
                .camera = shot.camera.name,
                .frame = frame,
                .width = shot.config.extent.x,
                .height = shot.config.extent.y,
                .technique = technique.technique,
                .point = technique.point,
                .seed = seed};
    }
};
