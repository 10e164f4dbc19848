#include "groundtruth/light_choice.h"

#include <algorithm>
#include <cmath>

namespace {

constexpr uint32_t whole = 1u << 24;  ///< probability 1

/// Share of the choice that is the same for all groups, independent of learning.
constexpr double even_share = 0.1;

/// A cell counts as if it had seen so many samples of each group with the mean of the cell around it.
constexpr double prior_samples = 8;

using Values = std::array<double, max_light_groups>;

Values posterior(const Values& sum, const Values& count, const Values& around) {
    Values means{};
    for (uint32_t g = 0; g < max_light_groups; ++g)
        means[g] = (sum[g] + prior_samples * around[g]) / (count[g] + prior_samples);
    return means;
}

}  // namespace

LightChoice::LightChoice(uint32_t groups) : groups_(groups) { cells_ = {shares_of(Values{})}; }

/// Whole numbers, so that the probabilities that a sample is divided by are exactly those that it was drawn with.
LightChoice::Shares LightChoice::shares_of(const Values& means) const {
    double total = 0;
    for (uint32_t g = 0; g < groups_; ++g) total += means[g];
    Shares shares{};
    uint32_t rest = whole, largest = 0;
    for (uint32_t g = 0; g < groups_; ++g) {
        const double learnt = total > 0 ? means[g] / total : 1.0 / groups_;
        shares[g] = uint32_t((even_share / groups_ + (1 - even_share) * learnt) * whole);
        rest -= shares[g];
        if (shares[g] > shares[largest]) largest = g;
    }
    shares[largest] += rest;
    return shares;
}

uint32_t LightChoice::find_cell(vec3 position, vec3 normal) const {
    if (const auto found = finest_.find(cell_key(position, normal, low_, finest_size_)); found != finest_.end())
        return found->second;
    const auto found = coarse_.find(cell_key(position, normal, low_, coarse_size_));
    return found != coarse_.end() ? found->second : 0;
}

void LightChoice::learn(std::span<const LightObservation> observations, vec3 low, vec3 high) {
    const float diagonal = std::sqrt(dot(high - low, high - low));
    if (groups_ < 2 || !(diagonal > 0)) return;
    low_ = low;
    finest_size_ = diagonal / finest_cells;
    coarse_size_ = diagonal / coarse_cells;

    Sums all;
    std::unordered_map<uint64_t, Sums> coarse;
    struct Finest {
        Sums sums;
        uint64_t around;
    };
    std::unordered_map<uint64_t, Finest> finest;
    for (const LightObservation& seen : observations) {
        const uint64_t around = cell_key(seen.position, seen.normal, low_, coarse_size_);
        Finest& cell = finest[cell_key(seen.position, seen.normal, low_, finest_size_)];
        cell.around = around;
        for (Sums* sums : {&all, &coarse[around], &cell.sums}) {
            sums->sum[seen.group] += double(seen.contribution);
            sums->count[seen.group] += 1;
        }
    }

    Values mean{};
    for (uint32_t g = 0; g < groups_; ++g) mean[g] = all.count[g] > 0 ? all.sum[g] / all.count[g] : 0.0;
    cells_ = {shares_of(mean)};
    std::unordered_map<uint64_t, Values> learnt;
    for (const auto& [key, sums] : coarse) {
        learnt[key] = posterior(sums.sum, sums.count, mean);
        coarse_[key] = uint32_t(cells_.size());
        cells_.push_back(shares_of(learnt[key]));
    }
    for (const auto& [key, cell] : finest) {
        finest_[key] = uint32_t(cells_.size());
        cells_.push_back(shares_of(posterior(cell.sums.sum, cell.sums.count, learnt[cell.around])));
    }
}

LightChoice::Choice LightChoice::sample(uint32_t cell, uint32_t bits) const {
    const Shares& shares = cells_[cell];
    uint32_t at = bits >> 8, group = 0;
    while (at >= shares[group]) at -= shares[group++];
    return {group, uint32_t((uint64_t(at) << 40 | uint64_t(bits & 0xff) << 32) / (uint64_t(shares[group]) << 8))};
}
