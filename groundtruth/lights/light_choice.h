#pragma once
#include "groundtruth/sampling/learning_grid.h"
#include "groundtruth/sampling/prefetch.h"

#include <cstdint>
#include <span>
#include <vector>

/// What one light sample found. Its group was chosen with the group's probability before learning.
struct LightObservation {
    vec3 position;  ///< where the light arrives (m)
    vec3 normal;    ///< geometric, on the side where it arrives
    uint32_t group;
    uint32_t light;      ///< of the group: see LightClusters::Choice
    float contribution;  ///< luminance that it added to the pixel, weights and visibility included
    float rarity = 0;    ///< density of the light sample over that with which the lobe finds the direction
    float relative = 0;  ///< contribution over the luminance of all light of the pixel
};

/// The probabilities with which a light sample chooses groups of lights, by the place where light arrives. They are
/// proportional to the light that arrives from each group on average, so that choosing adds the least variance. They
/// are learnt in cells of space and normal direction, from light samples of paths that a render does not use. Unlike
/// power, they account for lights that are hidden, far, or behind. (The root of the mean square is best for independent
/// samples, but follows rare bright ones, and stratified samples gain less.) Every group keeps a share everywhere, so
/// that no render's mean depends on the learning.
class LightChoice {
public:
    /// Before learning: each group has its share everywhere. `shares`: one per group, > 0, with a sum of 1.
    explicit LightChoice(std::vector<double> shares = {1.0});

    /// The same observations in the same order give the same choice to the bit.
    void learn(std::span<const LightObservation> observations, const LearningGrid& grid);

    /// The cell of an index of the grid; 0 stands for the whole scene.
    uint32_t cell(size_t index) const { return cells_.empty() ? 0 : cells_[index]; }
    // Prefetch what cell() will read, and what sample() and probability() will.
    void prefetch(size_t index) const {
        if (!cells_.empty()) prefetch_line(&cells_[index]);
    }
    void prefetch_cell(uint32_t cell) const { prefetch_line(&ends_[size_t(cell) * groups_]); }

    float probability(uint32_t cell, uint32_t group) const {
        const uint32_t* ends = &ends_[size_t(cell) * groups_];
        return float(ends[group] - (group ? ends[group - 1] : 0)) * 0x1p-24f;
    }

    struct Choice {
        uint32_t group, rest;  ///< rest: uniform 32-bit fixed point
    };
    /// A group with its probability(). `bits`: uniform 32-bit fixed point.
    Choice sample(uint32_t cell, uint32_t bits) const;

private:
    void add_cell(std::span<const double> means);

    std::vector<double> shares_;
    uint32_t groups_;
    std::vector<uint32_t> cells_;  ///< of the grid; empty: nothing is learnt
    std::vector<uint32_t> ends_;  ///< of each cell: sums of the groups' probabilities up to each (2^-24); the last is 1
};
