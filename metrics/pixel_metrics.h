#pragma once
#include "metrics/metric.h"

/// The metrics that look at one pixel at a time, as rows of the table: mse ... outliers.
std::vector<Metric> pixel_metrics();
