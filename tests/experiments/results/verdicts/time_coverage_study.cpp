// The table of times in metrics/coverage.md: time_coverage_study RESULTS, a folder of many timed frames
// (experiments/studies/configs/tradeoff_coverage.json). All frames of a shot are the truth, windows of 15 successive
// ones the trials.
#include "core/error.h"
#include "experiments/results/cells/cell.h"
#include "experiments/results/files/columns.h"
#include "metrics/statistics/median_interval.h"

#include <cstdio>
#include <map>

namespace {

using PointOfShot = std::tuple<std::string, std::string, std::string>;  // shot, technique, point
constexpr size_t window = 15, fewest_frames = 4 * window;

struct Count {
    size_t trials = 0, covered = 0;
    double half_widths = 0;  ///< relative
    void add(const Estimate& m, double truth) {
        ++trials, covered += m.low <= truth && truth <= m.high;
        half_widths += (m.high - m.low) / 2 / truth;
    }
    void print(const char* what) const {
        std::printf("| %s | %.1f %% of %zu | %.1f %% |\n", what, 100.0 * double(covered) / double(trials), trials,
                    100 * half_widths / double(trials));
    }
};

void add_windows(Count& count, const std::vector<double>& values) {
    const double truth = median_interval(values).value;
    for (size_t first = 0; first + window <= values.size(); first += 5)
        count.add(median_interval(std::span(values).subspan(first, window)), truth);
}

}  // namespace

int main(int argc, char** argv) {
    try {
        if (argc != 2) fail("usage: time_coverage_study RESULTS");
        std::map<PointOfShot, std::vector<double>> totals;  // in order of time
        for (const TimeRow& row : read_rows<TimeRow>(std::filesystem::path(argv[1]) / "times.csv"))
            if (row.stage == "total" && !row.technique.empty())
                totals[{row.shot, row.technique, row.point}].push_back(row.milliseconds);
        std::erase_if(totals, [](const auto& entry) { return entry.second.size() < fewest_frames; });
        if (totals.empty()) fail(argv[1], " has no point with ", fewest_frames, " timed frames");
        Count medians, ratios;
        for (auto a = totals.begin(); a != totals.end(); ++a) {
            add_windows(medians, a->second);
            for (auto b = std::next(a); b != totals.end(); ++b) {
                if (std::get<0>(a->first) != std::get<0>(b->first) || a->second.size() != b->second.size()) continue;
                std::vector<double> of_frames;
                for (size_t i = 0; i < a->second.size(); ++i) of_frames.push_back(a->second[i] / b->second[i]);
                add_windows(ratios, of_frames);
            }
        }
        std::printf("| of %zu points, %zu frames each | covered | half width |\n|---|---|---|\n", totals.size(),
                    totals.begin()->second.size());
        medians.print("median time"), ratios.print("ratio of two points' times");
    } catch (const Error& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 2;
    }
}
