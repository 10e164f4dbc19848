// Intervals over references of the path tracer itself, whose noise has heavy tails: the small form of coverage_study.
#include "tests/experiments/study/measuring/coverage.h"

#include <gtest/gtest.h>
#include <cmath>
#include <map>

namespace {

struct Case {
    const char* scene;
    unsigned samples;
};

}  // namespace

TEST(NoiseCoverage, HoldsForReferencesOfThePathTracer) {
    // Mirrors that meet lamps with few of their samples, and a gradient of roughnesses.
    for (const Case& c : {Case{"mirror_pillars", 64}, Case{"roughness_gradient", 64}}) {
        const std::vector<CoverageRow> rows = coverage({.scene = c.scene,
                                                        .extent = {24, 14},
                                                        .samples = c.samples,
                                                        .seeds = 150,
                                                        .targets = {"specular", "incident", "on_screen"},
                                                        .metrics = {"mse", "relmse", "bias", "energy_ratio"},
                                                        .draws = 1});
        size_t judged = 0;
        for (const CoverageRow& row : rows) {
            // Where few pixels carry nearly all noise, some seeds have an interval and most have not.
            if ((row.mask != "all" && row.mask != "reflective") || row.intervals < 0.9 * row.trials) continue;
            const std::string what = row.scene + " " + row.test + " " + row.target + " " + row.mask + " " + row.metric;
            ++judged;
            // Coverage is 93 to 97 %; five standard deviations of 93 % in 150 trials: a false alarm of 3e-7 each.
            EXPECT_GE(row.coverage(), 0.93 - 5 * std::sqrt(0.93 * 0.07 / row.intervals)) << what;
            // No bias above a quarter of the half-width, and five standard errors of the mean.
            EXPECT_LE(std::abs(row.mean - row.truth),
                      0.25 * row.half_width + 5 * row.deviation / std::sqrt(row.intervals))
                << what;
        }
        EXPECT_GE(judged, 40u) << c.scene;
    }
}

/// FLIP keeps the reference's noise in its values; its intervals reach to where it would lie without.
TEST(NoiseCoverage, HoldsOverSeedsForMetricsThatAreNoMeansOfSquares) {
    std::map<std::string, CoverageRow> by_metric;
    for (const char* scene : {"roughness_gradient", "fence"})
        for (const CoverageRow& row : technique_coverage({.scene = scene,
                                      .extent = {48, 36},
                                      .samples = 16,
                                      .seeds = 24,
                                      .targets = {"specular"},
                                      .metrics = {"flip", "relmse_trimmed"}},
                                                         4)) {
            // Of so few samples the noise may be all of an error, whose ratio then has no interval; a squared bias that
            // is none has no ratio.
            const bool is_effect = row.metric.starts_with("effect"), is_split = row.metric.ends_with("bias_squared");
            if (!is_split) {
                EXPECT_GE(row.intervals, row.trials * (is_effect ? 0.9 : 1))
                    << row.test << ' ' << row.metric << ": those without a seed, too";
            }
            CoverageRow& sum = by_metric[row.metric];
            sum.trials += row.trials, sum.intervals += row.intervals, sum.covered += row.covered;
        }
    EXPECT_GE(by_metric.size(), 7u) << "the two metrics, bias and variance, and effects on them";
    for (const auto& [metric, row] : by_metric) {
        // The three techniques share each reference: as few as 48 independent trials. At 64 samples coverage is 93 % or
        // more (metrics/coverage.md); five deviations of 93 % in 48 trials are a false alarm of 3e-7. Seeds alone cover
        // 81 % of FLIP.
        EXPECT_GE(row.coverage(), 0.93 - 5 * std::sqrt(0.93 * 0.07 / 48)) << metric;
    }
}
