#pragma once
#include "metrics/metric.h"

/// Structural similarity, as rows of the table: ssim.
std::vector<Metric> ssim_metrics();
