#include "groundtruth/paths/expected_radiance.h"

namespace {

/// A cell counts as if it had seen so many paths with the mean of the cell around it.
constexpr double prior_paths = 8;

struct Sum {
    double sum = 0, count = 0;
    double mean(double around) const { return (sum + prior_paths * around) / (count + prior_paths); }
};

}  // namespace

void ExpectedRadiance::learn(std::span<const RadianceObservation> observations, vec3 low, vec3 high) {
    if (observations.empty() || !(dot(high - low, high - low) > 0)) return;
    grid_ = LearningGrid(low, high);
    Sum all;
    std::vector<Sum> coarse(grid_.size()), fine(grid_.size());
    for (const RadianceObservation& seen : observations) {
        const size_t cell = grid_.index(seen.position, seen.normal);
        for (Sum* sum : {&all, &coarse[grid_.coarse_index(cell)], &fine[cell]})
            sum->sum += double(seen.radiance), sum->count += 1;
    }
    const double mean = all.sum / all.count;
    radiance_.resize(grid_.size());
    for (size_t cell = 0; cell < radiance_.size(); ++cell)
        radiance_[cell] = float(fine[cell].mean(coarse[grid_.coarse_index(cell)].mean(mean)));
}

float ExpectedRadiance::at(vec3 position, vec3 normal) const {
    return radiance_.empty() ? 0.0f : radiance_[grid_.index(position, normal)];
}
