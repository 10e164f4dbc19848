// The table of metrics/coverage.md: coverage_study [SEEDS] > rows.csv, and the table to standard error.
#include "core/error.h"
#include "tests/experiments/study/measuring/coverage.h"

#include <cstdio>
#include <cstdlib>
#include <map>
#include <utility>

namespace {

constexpr unsigned sample_counts[] = {16, 64, 256, 1024};

struct Count {
    double trials = 0, intervals = 0, covered = 0;

    void add(const CoverageRow& row) { trials += row.trials, intervals += row.intervals, covered += row.covered; }
};

/// One line of the table: counts by number of samples.
using Line = std::map<unsigned, Count>;

void print(const std::string& title, const Line& line) {
    std::fprintf(stderr, "| %s |", title.c_str());
    for (const unsigned samples : sample_counts) {
        const Count& c = line.at(samples);
        if (c.intervals < 0.001 * c.trials)
            std::fprintf(stderr, " none |");
        else
            std::fprintf(stderr, " %.1f %% of %.0f %% |", 100 * c.covered / c.intervals, 100 * c.intervals / c.trials);
    }
    std::fprintf(stderr, "\n");
}

}  // namespace

int main(int argc, char** argv) {
    try {
        const unsigned seeds = argc > 1 ? unsigned(std::atoi(argv[1])) : 200;
        std::map<std::string, Line> masks, metrics, rungs;  // masks and metrics are of results
        std::printf(
            "scene,samples,test,target,mask,metric,trials,intervals,coverage,truth,bias_in_half_widths,half_width\n");
        for (const char* scene : {"roughness_gradient", "mirror_pillars", "fence", "firefly"})
            for (const unsigned samples : sample_counts) {
                const CoverageSetting setting{
                    .scene = scene,
                    .extent = {32, 18},
                    .samples = samples,
                    .seeds = samples == 1024 ? seeds / 8 * 2 : seeds,  // even: truths have halves
                    .targets = {"specular", "image", "incident", "camera_radiance", "on_screen"},
                    .metrics = {"mse", "relmse", "bias", "energy_ratio"}};
                for (const CoverageRow& r : coverage(setting)) {
                    if (r.intervals > 0)
                        std::printf("%s,%u,%s,%s,%s,%s,%.0f,%.0f,%.4f,%.6g,%.3f,%.4g\n", scene, samples, r.test.c_str(),
                                    r.target.c_str(), r.mask.c_str(), r.metric.c_str(), r.trials, r.intervals,
                                    r.coverage(), r.truth, r.bias_in_half_widths(), r.half_width);
                    if (r.test.starts_with("rung")) {
                        rungs[r.test + " in " + r.scene][samples].add(r);
                    } else {
                        masks[r.mask][samples].add(r);
                        metrics[r.metric][samples].add(r);
                    }
                }
                std::fflush(stdout);
            }
        std::fprintf(stderr, "| | 16 samples | 64 | 256 | 1024 |\n|---|---|---|---|---|\n");
        for (const auto& [prefix, lines] :
             {std::pair("mask `", &masks), std::pair("metric `", &metrics), std::pair("`", &rungs)})
            for (const auto& [name, line] : *lines)
                if (line.size() == std::size(sample_counts)) print(prefix + name + "`", line);
    } catch (const Error& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 2;
    }
}
