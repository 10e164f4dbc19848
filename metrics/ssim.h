#pragma once
#include "metrics/metric.h"

/// Structural similarity, as rows of the table: ssim.
std::vector<Metric> ssim_metrics();

/// SSIM at each pixel, the mean of the three channels, of codes from 0 to `range`. Its margin is half a window. Fails
/// if a side is below the window's 11 pixels.
Plane mean_similarity(const HostImage& x, const HostImage& y, double range);
