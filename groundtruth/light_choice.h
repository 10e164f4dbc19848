#pragma once
#include "groundtruth/cell_key.h"

#include <array>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

inline constexpr uint32_t max_light_groups = 8;

/// What one light sample found, for a group that was chosen with probability 1 / (number of groups).
struct LightObservation {
    vec3 position;  ///< where the light arrives (m)
    vec3 normal;    ///< geometric, on the side where it arrives
    uint32_t group;
    float contribution;  ///< luminance that it added to the pixel, weights and visibility included
};

/// With which probability a light sample chooses each group of lights, depending on where the light is to arrive: in
/// proportion to what arrives from each on average, so that choosing adds the least variance. It is learnt from light
/// samples of paths that a render does not use, in cells of space and of the normal's direction: unlike power, it knows
/// what is hidden, far, or behind. (In proportion to the root of the mean square, which is best for independent
/// samples, the rare bright ones decide, and stratified samples gain less.) Every group keeps a share everywhere, so
/// that no render's mean depends on what was learnt.
class LightChoice {
public:
    /// Nothing is learnt: every group is as likely as any other, everywhere.
    explicit LightChoice(uint32_t groups = 1);

    /// `low`, `high`: bounds of the scene (m). The same observations in the same order give the same choice to the bit.
    void learn(std::span<const LightObservation> observations, vec3 low, vec3 high);

    /// The cell of a point (m) with a unit normal; 0 stands for the whole scene.
    uint32_t cell(vec3 position, vec3 normal) const { return finest_.empty() ? 0 : find_cell(position, normal); }
    float probability(uint32_t cell, uint32_t group) const { return float(cells_[cell][group]) * 0x1p-24f; }

    struct Choice {
        uint32_t group, rest;  ///< rest: uniform 32-bit fixed point
    };
    /// A group with its probability(). `bits`: uniform 32-bit fixed point.
    Choice sample(uint32_t cell, uint32_t bits) const;

private:
    using Shares = std::array<uint32_t, max_light_groups>;  ///< in 2^-24; they add up to 1 exactly
    struct Sums {
        std::array<double, max_light_groups> sum{}, count{};
    };
    uint32_t find_cell(vec3 position, vec3 normal) const;
    Shares shares_of(const std::array<double, max_light_groups>& means) const;

    uint32_t groups_;
    vec3 low_{0.0f};
    float finest_size_ = 0.0f, coarse_size_ = 0.0f;  ///< of cells (m)
    std::unordered_map<uint64_t, uint32_t> finest_, coarse_;
    std::vector<Shares> cells_;
};
