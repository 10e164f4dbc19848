#include "groundtruth/paths/expected_radiance.h"

namespace {

/// A cell counts as if it had seen so many paths with the mean of the cell around it.
constexpr double prior_paths = 8;

struct Sum {
    double sum = 0, count = 0;
    double mean(double around) const { return (sum + prior_paths * around) / (count + prior_paths); }
};

}  // namespace

void ExpectedRadiance::learn(std::span<const RadianceObservation> observations, const LearningGrid& grid) {
    if (observations.empty() || grid.size() == 0) return;
    Sum all;
    std::vector<Sum> coarse(grid.size()), fine(grid.size());
    for (const RadianceObservation& seen : observations) {
        const size_t cell = grid.index(seen.position, seen.normal);
        for (Sum* sum : {&all, &coarse[grid.coarse_index(cell)], &fine[cell]})
            sum->sum += double(seen.radiance), sum->count += 1;
    }
    const double mean = all.sum / all.count;
    radiance_.resize(grid.size());
    for (size_t cell = 0; cell < radiance_.size(); ++cell)
        radiance_[cell] = float(fine[cell].mean(coarse[grid.coarse_index(cell)].mean(mean)));
}
