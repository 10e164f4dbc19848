#pragma once
#include "metrics/metric.h"

#include <filesystem>
#include <iosfwd>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

/// The options of `ssrlab compare REFERENCE TEST`.
struct CompareOptions {
    std::filesystem::path reference, test;  ///< OpenEXR, Radiance: linear; PNG: sRGB codes, decoded for linear metrics
    std::string layer;                      ///< layer of EXR files; "": the choice of read_exr_rgb() (core/exr/exr.h)
    std::vector<std::string> metrics;       ///< names; empty: the usual metrics that the images allow
    std::filesystem::path
        map;  ///< file of error maps; .exr: one layer per metric; .png: one metric in false colour; empty: none
    float map_max = 1.0f;             ///< the error that is drawn as the brightest colour of a .png
    MetricSettings settings;          ///< without `flip_exposures`, the reference decides the exposures
    bool fail_on_non_finite = false;  ///< if false, means leave out non-finite pixels and a warning names them
};

struct CompareResult {
    const Metric* metric;
    double value;
    Plane map;
};

struct Comparison {
    CompareOptions options;  ///< as used, with the chosen metrics and exposures
    glm::uvec2 extent{0, 0};
    PixelCounts reference_counts, test_counts;
    size_t pixels = 0;  ///< finite in both images
    std::vector<std::string> warnings;
    std::vector<CompareResult> results;
};

/// Reads both files, measures, and writes `options.map` if it is set. Fails on unreadable files, different sizes,
/// unknown metrics, images too small for a metric, no finite pixel, and non-finite pixels if
/// options.fail_on_non_finite.
Comparison compare(const CompareOptions& options);

/// Prints one line per warning to `warnings`, then one line per metric to `out`: "mse 0.123". The digits read back
/// exactly.
void print(const Comparison& comparison, std::ostream& out, std::ostream& warnings);

nlohmann::json to_json(const Comparison& comparison);
