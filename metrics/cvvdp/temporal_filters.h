#pragma once
#include "metrics/cvvdp/calibration.h"

#include <vector>

/// The range of frame rates (frames per second) that have filters: above it, a window no longer spans 63 frames.
inline constexpr double least_frame_rate = 1, greatest_frame_rate = 240;

/// Taps of the four channels at `frames_per_second`, 2 ceil(fps / 8) + 1 of each, about a quarter of a second. Each
/// channel is symmetric: its middle tap is its largest, so a causal filter is late by half its length. Fails with
/// Error outside [least_frame_rate, greatest_frame_rate].
PerCvvdpChannel<std::vector<float>> temporal_filters(double frames_per_second, const CvvdpCalibration& calibration);
