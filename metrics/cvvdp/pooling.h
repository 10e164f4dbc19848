#pragma once
#include "metrics/cvvdp/calibration.h"

#include <vector>

/// The mean square of the differences in one frame, [band][channel]: band_difference() of each.
using VisibleDifferences = std::vector<PerCvvdpChannel<double>>;

/// One number of what an observer notices, 0 for nothing, from the frames of a video or from a still. `channels` is 3
/// or 4. `frames` is not empty.
double pooled_difference(const std::vector<VisibleDifferences>& frames, unsigned channels, bool is_still,
                         const CvvdpCalibration& calibration);

/// Just-objectionable differences: 10 for no difference, less for more. One less means that 75 % of observers prefer
/// the other. May be below 0.
double jod(double pooled_difference, const CvvdpCalibration& calibration);
