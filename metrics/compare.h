#pragma once
#include "metrics/cvvdp/cvvdp.h"
#include "metrics/metric.h"

#include <filesystem>
#include <iosfwd>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

/// How numbered files make a video.
struct VideoOptions {
    double frames_per_second;
    TemporalPadding padding = TemporalPadding::replicate;
};

/// The options of `ssrlab compare REFERENCE TEST`.
struct CompareOptions {
    std::filesystem::path reference, test;  ///< OpenEXR, Radiance: linear; PNG: sRGB codes, decoded for linear metrics
    std::string layer;                      ///< layer of EXR files; "": the choice of read_exr_rgb() (core/exr/exr.h)
    std::vector<std::string> metrics;       ///< names; empty: the usual metrics that the images allow
    std::filesystem::path
        map;  ///< file of error maps; .exr: one layer per metric; .png: one metric in false colour; empty: none
    float map_max = 1.0f;     ///< the error that is drawn as the brightest colour of a .png
    MetricSettings settings;  ///< without `flip_exposures`, the reference decides the exposures; `display` decides the
                              ///< viewing
    std::string display;      ///< of cvvdp_0_5_6; "": standard_hdr_linear for radiance, standard_4k for codes
    std::optional<double> nits_per_unit;  ///< of a linear display; default: that of Viewing
    std::optional<VideoOptions> video;    ///< both files are patterns (numbered_files()); metrics: cvvdp_0_5_6
    bool fail_on_non_finite = false;      ///< if false, means leave out non-finite pixels and a warning names them
};

struct CompareResult {
    const Metric* metric;
    double value;
    Plane map;
};

struct Comparison {
    CompareOptions options;  ///< as used, with the chosen metrics and exposures
    glm::uvec2 extent{0, 0};
    bool is_radiance = true;  ///< of the reference; else display codes
    PixelCounts reference_counts, test_counts;
    size_t pixels = 0;                     ///< finite in both images, of all frames
    size_t frames = 1, pooled_frames = 1;  ///< of a video: those that were read, and those that were pooled
    std::vector<std::string> warnings;
    std::vector<CompareResult> results;
};

/// Reads both files, measures, and writes `options.map` if it is set. Fails on unreadable files, different sizes,
/// unknown metrics, images too small for a metric, no finite pixel, and non-finite pixels if
/// options.fail_on_non_finite.
Comparison compare(const CompareOptions& options);

/// Prints one line per warning to `warnings`, then one line per metric to `out`: "mse 0.123". The digits read back
/// exactly. What a JOD depends on follows it, in brackets.
void print(const Comparison& comparison, std::ostream& out, std::ostream& warnings);

nlohmann::json to_json(const Comparison& comparison);
