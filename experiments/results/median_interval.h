#pragma once
#include <vector>

/// The median of the values and its distribution-free 95 % interval from order statistics (binomial with p = 1/2),
/// which needs at least 6 values; with fewer the interval is the range.
struct MedianInterval {
    double median = 0, low = 0, high = 0;
};
MedianInterval median_interval(std::vector<double> values);
