#pragma once
#include "metrics/metric.h"

/// Which values of a metric, of one frame (metric.h) or of a sequence (temporal.h), are good; none for unknown names.
std::optional<Better> direction_of(const std::string& metric);

/// Distance of a value from the best one, so that less is better for every metric: the value itself, its negative, or
/// its distance from 0 or 1. Only its differences are meaningful where `better` is `higher`.
double shortfall(Better better, double value);

/// Whether less of the metric, of one frame or of a sequence, is better. Such values are never negative, except through
/// the correction of noise. False for unknown names.
bool is_error(const std::string& metric);

/// The upper bound that the metric declares; infinity for unknown names.
double greatest_value(const std::string& metric);
