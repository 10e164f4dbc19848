#pragma once
#include "experiments/study/measuring/measure.h"

#include <glm/glm.hpp>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

/// How often intervals hold the truth, over references of many seeds of the path tracer itself: their noise has the
/// heavy tails of its rare bright paths.
struct CoverageSetting {
    std::string scene;
    glm::uvec2 extent;
    unsigned samples, seeds;
    std::vector<std::string> targets, metrics;
    unsigned draws = 8;  ///< of masks that hold pixels at random
};

/// One number of a result over the seeds (and, of masks with random pixels, over their draws). The truth is that of all
/// seeds together, whose noise is taken out as that of a single one.
struct CoverageRow {
    std::string scene;
    unsigned samples;
    std::string test, target, mask, metric;
    double trials = 0, intervals = 0, covered = 0;  ///< numbers of results, of those with an interval, of those hit
    double truth = 0, mean = 0, deviation = 0;      ///< of values with an interval, over the seeds
    double half_width = 0;                          ///< mean of (high - low) / 2

    double coverage() const { return covered / intervals; }
    double bias_in_half_widths() const { return (mean - truth) / half_width; }
};

/// Tests: `fallback` (the environment alone, as `none`), `on_screen` (all that the image shows: a small error),
/// `noisy` (the truth with the noise of 16 samples), and `rung`: the error of the ladder's `on_screen` itself.
/// Masks: `all`, `reflective`, `edge`; reflective pixels at random: `ten`, `hundred`; `dominant`: the noisiest pixels,
/// each with 40 of the quieter half.
std::vector<CoverageRow> coverage(const CoverageSetting& setting);

/// Images of each technique by seed, a single one where it has none, and which are compared with which.
struct Techniques {
    std::map<std::string, std::vector<CompositedImages>> images;
    std::vector<std::pair<std::string, std::vector<std::string>>> baselines;  ///< and what is compared with each
};

/// The same of intervals over the seeds of techniques (summary.csv, splits.csv, effects.csv), against each of
/// `references` by `technique_seeds` of the seeds. The truth is the mean over all seeds, most_seeds at most, against
/// `truth`. Tests: the techniques; "a / b" for effects.
std::vector<CoverageRow> technique_coverage(const CoverageSetting& setting, const Techniques& techniques,
                                            std::span<const Mask> masks, const Reference& truth,
                                            std::span<const Reference> references, unsigned technique_seeds);
inline constexpr unsigned most_seeds = 64;

/// The same of techniques that are made by the path tracer: `fallback`, which has no seed; `noisy` (the truth with the
/// noise of 16 samples); `denoised` (the same, means of 5x5 pixels). Masks: `all` and `reflective`. The truth has 128
/// times the samples of one of `setting.seeds` references.
std::vector<CoverageRow> technique_coverage(const CoverageSetting& setting, unsigned technique_seeds);
