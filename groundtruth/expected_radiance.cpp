#include "groundtruth/expected_radiance.h"

namespace {

/// A cell counts as if it had seen so many paths with the mean of the cell around it.
constexpr double prior_paths = 8;

struct Sum {
    double sum = 0, count = 0;
    double mean(double around) const { return (sum + prior_paths * around) / (count + prior_paths); }
};

}  // namespace

void ExpectedRadiance::learn(std::span<const RadianceObservation> observations, vec3 low, vec3 high) {
    const float diagonal = std::sqrt(dot(high - low, high - low));
    if (observations.empty() || !(diagonal > 0)) return;
    low_ = low;
    finest_size_ = diagonal / finest_cells;
    coarse_size_ = diagonal / coarse_cells;

    struct Finest {
        Sum sum;
        uint64_t around;
    };
    Sum all;
    std::unordered_map<uint64_t, Sum> coarse;
    std::unordered_map<uint64_t, Finest> finest;
    for (const RadianceObservation& seen : observations) {
        const uint64_t around = cell_key(seen.position, seen.normal, low_, coarse_size_);
        Finest& cell = finest[cell_key(seen.position, seen.normal, low_, finest_size_)];
        cell.around = around;
        for (Sum* sum : {&all, &coarse[around], &cell.sum}) sum->sum += double(seen.radiance), sum->count += 1;
    }
    const double mean = all.sum / all.count;
    mean_ = float(mean);
    for (const auto& [key, sum] : coarse) coarse_[key] = float(sum.mean(mean));
    for (const auto& [key, cell] : finest) finest_[key] = float(cell.sum.mean(coarse[cell.around].mean(mean)));
}

float ExpectedRadiance::at(vec3 position, vec3 normal) const {
    if (const auto found = finest_.find(cell_key(position, normal, low_, finest_size_)); found != finest_.end())
        return found->second;
    const auto found = coarse_.find(cell_key(position, normal, low_, coarse_size_));
    return found != coarse_.end() ? found->second : mean_;
}
