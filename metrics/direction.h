#pragma once
#include "metrics/metric.h"

/// Which values of a metric of one frame (metric.h) or of a sequence (temporal.h) are good. None for unknown names.
std::optional<Better> direction_of(const std::string& metric);

/// Distance of a value from the best value, so that less is better for every metric: the value itself, its negative, or
/// its distance from 0 or 1. With Better::higher, only differences of shortfalls are meaningful.
double shortfall(Better better, double value);

/// Whether lower values of the metric are better. Such a metric is negative only through noise correction. False for
/// unknown names.
bool is_error(const std::string& metric);

/// The upper bound that the metric declares; infinity for unknown names.
double greatest_value(const std::string& metric);
