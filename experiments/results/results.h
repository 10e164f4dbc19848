#pragma once
#include "experiments/results/cell.h"

#include <filesystem>
#include <nlohmann/json.hpp>

/// Writes results.csv, splits.csv and times.csv, and hits.csv if rays were judged, in the order of `cells`; the columns
/// are those of experiments/RESULTS.md.
void write_tables(const std::filesystem::path& folder, const std::vector<Cell>& cells);

/// The median of the values and its distribution-free 95 % interval from order statistics (binomial with p = 1/2),
/// which needs at least 6 values; with fewer the interval is the range.
struct MedianInterval {
    double median = 0, low = 0, high = 0;
};
MedianInterval median_interval(std::vector<double> values);
