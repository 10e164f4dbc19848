#pragma once
#include "core/shared/language.h"
#include "groundtruth/sampling/alias_table.h"

#include <span>
#include <vector>

/// What LightClusters knows of a light.
struct LightExtent {
    vec3 center{0.0f};           ///< m
    vec3 normal{0.0f};           ///< unit, on the side that emits; zero: every side
    float square_radius = 0.0f;  ///< mean square of the distances of its points from `center` (m^2), > 0
    double power = 0;            ///< > 0, in any unit
};

/// Chooses one light of a group for the point where its light arrives. The lights form at most 16 clusters. A cluster
/// is chosen by its power, how it faces the point, and the square of its distance; a light of it by power. (Conty
/// Estevez and Kulla 2018, "Importance Sampling of Many Lights with Adaptive Tree Splitting", have such a weight, and a
/// tree. One level is a vector loop.)
class LightClusters {
public:
    explicit LightClusters(std::span<const LightExtent> lights);  ///< at least one

    struct Choice {
        uint32_t light;  ///< index in the group
        uint32_t rest;   ///< uniform 32-bit fixed point
        float probability;
    };
    /// `point`: m. `bits`: uniform 32-bit fixed point.
    Choice sample(vec3 point, uint32_t bits) const;
    /// With which sample() chooses a light for a point.
    float probability(uint32_t light, vec3 point) const;

private:
    static constexpr size_t most_clusters = 16, vector = 8;
    using Values = float[most_clusters];  ///< of each cluster; 0 beyond the last

    void add_cluster(std::span<const LightExtent> lights, std::vector<uint32_t> members, double group_power);
    float weigh(vec3 point, Values& weights, Values& ends) const;

    struct Member {
        uint32_t cluster;
        float probability;  ///< within the cluster
    };
    struct Cluster {
        std::vector<uint32_t> lights;
        AliasTable table;
    };
    std::vector<Member> members_;  ///< of each light
    std::vector<Cluster> clusters_;
    size_t lanes_ = 0;                                                    ///< clusters_.size(), rounded up to vectors
    alignas(64) Values x_{}, y_{}, z_{}, radius_{};                       ///< center and extent (m)
    alignas(64) Values normal_x_{}, normal_y_{}, normal_z_{}, spread_{};  ///< mean normal by power; 1 - its length
    alignas(64) Values share_{};                                          ///< of the group's power
};
