#pragma once
#include "metrics/cvvdp/calibration.h"

#include <vector>

/// The range of frame rates (frames per second) that have filters. The window of the greatest spans 61 frames.
inline constexpr double least_frame_rate = 1, greatest_frame_rate = 240;

/// The frames that a filter spans: 2 ceil(fps / 8) + 1, about a quarter of a second. Fails with Error outside
/// [least_frame_rate, greatest_frame_rate].
unsigned filter_window(double frames_per_second);

/// The taps of the four channels, filter_window() of each. They are symmetric and largest in the middle, so a causal
/// filter is late by half its length. Fails as filter_window().
PerCvvdpChannel<std::vector<float>> temporal_filters(double frames_per_second, const CvvdpCalibration& calibration);
