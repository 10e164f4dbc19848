// The second table of metrics/README.md: technique_coverage_study [REFERENCES] > rows.csv, and the table to standard
// error.
#include "core/error.h"
#include "tests/experiments/measuring/coverage.h"

#include <cstdio>
#include <cstdlib>
#include <map>
#include <utility>

namespace {

constexpr unsigned seed_counts[] = {4, 8};
const char* const scenes[] = {"roughness_gradient", "mirror_pillars", "fence", "firefly",
                              "passing_pillars",    "thin_pole"};

struct Count {
    double trials = 0, intervals = 0, covered = 0;
    double least = 1;  ///< coverage of one scene
};

}  // namespace

int main(int argc, char** argv) {
    try {
        const unsigned references = argc > 1 ? unsigned(std::atoi(argv[1])) : 24;
        std::map<std::pair<std::string, unsigned>, Count> table;
        std::printf("scene,seeds,test,target,mask,metric,trials,intervals,coverage,truth,mean,half_width\n");
        for (const char* scene : scenes)
            for (const unsigned seeds : seed_counts) {
                std::map<std::string, Count> own;
                for (const CoverageRow& r : technique_coverage(
                         {.scene = scene,
      .extent = {64, 36},
      .samples = 64,
      .seeds = references,
      .targets = {"specular", "image"},
      .metrics = {"mse", "relmse", "flip", "ssim", "mae", "smape", "psnr", "outliers", "relmse_trimmed"}},
                         seeds)) {
                    std::printf("%s,%u,%s,%s,%s,%s,%.0f,%.0f,%.4f,%.6g,%.6g,%.4g\n", scene, seeds, r.test.c_str(),
                                r.target.c_str(), r.mask.c_str(), r.metric.c_str(), r.trials, r.intervals, r.coverage(),
                                r.truth, r.mean, r.half_width);
                    for (Count* c : {&table[{r.metric, seeds}], &own[r.metric]})
                        c->trials += r.trials, c->intervals += r.intervals, c->covered += r.covered;
                }
                for (const auto& [metric, c] : own)
                    if (c.intervals > 0)
                        table[{metric, seeds}].least = std::min(table[{metric, seeds}].least, c.covered / c.intervals);
                std::fflush(stdout);
            }
        std::fprintf(stderr, "| metric | 4 seeds | 8 seeds | least of a scene, 4 | 8 |\n|---|---|---|---|---|\n");
        for (const auto& [key, four] : table) {
            if (key.second != 4) continue;
            const Count& eight = table.at({key.first, 8});
            std::fprintf(stderr, "| `%s` | %.1f %% of %.0f %% | %.1f %% of %.0f %% | %.1f %% | %.1f %% |\n",
                         key.first.c_str(), 100 * four.covered / four.intervals, 100 * four.intervals / four.trials,
                         100 * eight.covered / eight.intervals, 100 * eight.intervals / eight.trials, 100 * four.least,
                         100 * eight.least);
        }
    } catch (const Error& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 2;
    }
}
