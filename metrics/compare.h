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
    std::string layer;                      ///< of EXR files; "": as read_exr_rgb() of core/exr/exr.h chooses
    std::vector<std::string> metrics;       ///< names; empty: all that are usual and that the images allow
    std::filesystem::path
        map;                  ///< error maps, .exr: a layer per metric, or .png: one metric, false colour; empty: none
    float map_max = 1.0f;     ///< the error that is drawn as the brightest colour of a .png
    MetricSettings settings;  ///< without flip_exposures they are taken from the reference
    bool fail_on_non_finite = false;  ///< else non-finite pixels are left out of every mean and warned about
};

struct CompareResult {
    const Metric* metric;
    double value;
    Plane map;
};

struct Comparison {
    CompareOptions options;  ///< as used: with the metrics and exposures that were chosen
    glm::uvec2 extent{0, 0};
    PixelCounts reference_counts, test_counts;
    size_t pixels = 0;  ///< finite in both images
    std::vector<std::string> warnings;
    std::vector<CompareResult> results;
};

/// Reads both files, measures, and writes options.map if asked to. Fails on unreadable files, different sizes, unknown
/// metrics, images too small for a metric, no finite pixel, and non-finite pixels if options.fail_on_non_finite.
Comparison compare(const CompareOptions& options);

/// Warnings to `warnings`, each as one line; then one line per metric to `out`: "mse 0.123", in digits that read back
/// exactly.
void print(const Comparison& comparison, std::ostream& out, std::ostream& warnings);

nlohmann::json to_json(const Comparison& comparison);
