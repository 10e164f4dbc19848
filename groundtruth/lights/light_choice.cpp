#include "groundtruth/lights/light_choice.h"

#include <algorithm>

namespace {

constexpr uint32_t whole = 1u << 24;  ///< probability 1

/// Share of the choice that learning leaves as it was.
constexpr double unlearnt_share = 0.1;

/// A cell counts as if it had seen so many samples of each group with the mean of the cell around it.
constexpr double prior_samples = 8;

}  // namespace

LightChoice::LightChoice(std::vector<double> shares) : shares_(std::move(shares)), groups_(uint32_t(shares_.size())) {
    add_cell(shares_);
}

/// Whole numbers, so that the probabilities that a sample is divided by are exactly those that it was drawn with.
void LightChoice::add_cell(std::span<const double> means) {
    double total = 0;
    for (const double mean : means) total += mean;
    double end = 0;
    for (size_t g = 0; g < groups_; ++g) {
        end += unlearnt_share * shares_[g] + (1 - unlearnt_share) * (total > 0 ? means[g] / total : shares_[g]);
        ends_.push_back(uint32_t(std::min(end, 1.0) * whole));
    }
    ends_.back() = whole;
}

void LightChoice::learn(std::span<const LightObservation> observations, const LearningGrid& grid) {
    if (groups_ < 2 || grid.size() == 0) return;

    // Cells are numbered as they are seen: the whole scene, the coarse ones, the fine ones.
    std::vector<uint32_t> coarse(grid.size(), 0), around{0};  // around: of each cell, the one that holds it
    cells_.assign(grid.size(), 0);
    const auto number = [&](uint32_t& cell, uint32_t holder) {
        if (cell != 0) return;
        cell = uint32_t(around.size());
        around.push_back(holder);
    };
    std::vector<size_t> places;
    for (const LightObservation& seen : observations) {
        places.push_back(grid.index(seen.position, seen.normal));
        number(coarse[grid.coarse_index(places.back())], 0);
    }
    for (const size_t place : places) number(cells_[place], coarse[grid.coarse_index(place)]);

    std::vector<double> sum(around.size() * groups_, 0.0), count(sum.size(), 0.0), mean(sum.size(), 0.0);
    for (size_t i = 0; i < observations.size(); ++i) {
        const LightObservation& seen = observations[i];
        for (const uint32_t cell : {0u, coarse[grid.coarse_index(places[i])], cells_[places[i]]}) {
            sum[size_t(cell) * groups_ + seen.group] += double(seen.contribution) * shares_[seen.group];
            count[size_t(cell) * groups_ + seen.group] += 1;
        }
    }
    ends_.clear();
    for (size_t cell = 0; cell < around.size(); ++cell) {
        for (size_t g = 0; g < groups_; ++g) {
            const size_t at = cell * groups_ + g;
            const double prior = cell ? prior_samples : 0, samples = count[at] + prior;
            if (samples > 0) mean[at] = (sum[at] + prior * mean[size_t(around[cell]) * groups_ + g]) / samples;
        }
        add_cell(std::span(mean).subspan(cell * groups_, groups_));
    }
    for (size_t place = 0; place < cells_.size(); ++place)
        if (cells_[place] == 0) cells_[place] = coarse[grid.coarse_index(place)];
}

LightChoice::Choice LightChoice::sample(uint32_t cell, uint32_t bits) const {
    const auto ends = std::span(ends_).subspan(size_t(cell) * groups_, groups_);
    const uint32_t at = bits >> 8;
    const auto end = std::ranges::upper_bound(ends, at);
    const uint32_t start = end == ends.begin() ? 0 : *(end - 1);
    return {uint32_t(end - ends.begin()),
            uint32_t((uint64_t(at - start) << 40 | uint64_t(bits & 0xff) << 32) / (uint64_t(*end - start) << 8))};
}
