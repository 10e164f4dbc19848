// What metrics/README.md says of intervals: coverage_study [SEEDS] > rows.csv, and the summary to standard error.
#include "core/error.h"
#include "tests/experiments/coverage.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>

namespace {

struct Summary {
    double trials = 0, intervals = 0, covered = 0, worst_bias = 0, numbers = 0, biased = 0;

    void add(const CoverageRow& row) {
        trials += row.trials, intervals += row.intervals, covered += row.covered;
        if (row.intervals < 30) return;
        // Four standard errors of the mean are not told from no bias.
        const double error = row.deviation / std::sqrt(row.intervals) / row.half_width;
        const double bias = std::max(std::abs(row.bias_in_half_widths()) - 4 * error, 0.0);
        worst_bias = std::max(worst_bias, bias), ++numbers, biased += bias > 0.25;
    }
};

}  // namespace

int main(int argc, char** argv) {
    try {
        const unsigned seeds = argc > 1 ? unsigned(std::atoi(argv[1])) : 200;
        std::map<std::tuple<std::string, unsigned>, Summary> summaries;  // by mask, or metric, and samples
        std::printf(
            "scene,samples,test,target,mask,metric,trials,intervals,coverage,truth,bias_in_half_widths,half_width\n");
        for (const char* scene : {"roughness_gradient", "mirror_pillars", "fence", "firefly"})
            for (const unsigned samples : {16u, 64u, 256u, 1024u}) {
                const CoverageSetting setting{
                    .scene = scene,
                    .extent = {32, 18},
                    .samples = samples,
                    .seeds = samples == 1024 ? seeds / 4 : seeds,
                    .targets = {"specular", "image", "incident", "camera_radiance", "on_screen"},
                    .metrics = {"mse", "rmse", "relmse", "relmse_b", "relmse_d", "bias", "energy_ratio"}};
                for (const CoverageRow& r : coverage(setting)) {
                    if (r.intervals > 0)
                        std::printf("%s,%u,%s,%s,%s,%s,%.0f,%.0f,%.4f,%.6g,%.3f,%.4g\n", scene, samples, r.test.c_str(),
                                    r.target.c_str(), r.mask.c_str(), r.metric.c_str(), r.trials, r.intervals,
                                    r.coverage(), r.truth, r.bias_in_half_widths(), r.half_width);
                    summaries[{"mask " + r.mask, samples}].add(r);
                    summaries[{"metric " + r.metric, samples}].add(r);
                    summaries[{"target " + r.target, samples}].add(r);
                    summaries[{"test " + r.test, samples}].add(r);
                }
                std::fflush(stdout);
            }
        std::fprintf(
            stderr,
            "| | samples | with an interval | coverage | greatest bias, in half-widths |\n|---|---|---|---|---|\n");
        for (const auto& [key, s] : summaries)
            std::fprintf(stderr, "| %s | %u | %.1f %% | %.1f %% | %.2f |\n", std::get<0>(key).c_str(), std::get<1>(key),
                         100 * s.intervals / s.trials, 100 * s.covered / s.intervals, s.worst_bias);
    } catch (const Error& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 2;
    }
}
