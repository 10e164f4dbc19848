#pragma once
#include "core/scene/scene.h"
#include "groundtruth/alias_table.h"

/// Draws directions in proportion to the luminance of an environment, from a table over latitude and longitude (Pharr,
/// Jakob and Humphreys 2023, "Physically Based Rendering", section 12.5).
class EnvironmentTable {
public:
    EnvironmentTable() = default;
    /// `compensate` lowers the density where BSDF sampling does well (Karlik et al. 2019, "MIS Compensation"):
    /// directions dimmer than the mean are then never drawn, so it must not be used without BSDF sampling.
    EnvironmentTable(const Environment& environment, bool compensate);

    bool empty() const { return cells_.empty(); }
    double mean_luminance() const { return mean_luminance_; }  ///< over the sphere

    glm::vec3 sample(glm::uvec2 bits, float& pdf) const;  ///< unit direction; pdf in sr^-1
    float pdf(glm::vec3 direction) const;                 ///< with which sample() draws a unit direction, sr^-1

private:
    unsigned width_ = 0, height_ = 0;  ///< cells in longitude and latitude
    glm::vec2 cell_extent_{0.0f};      ///< in uv
    float rotation_ = 0;
    AliasTable cells_;
    std::vector<float> density_;  ///< of each cell, sr^-1
    double mean_luminance_ = 0;
};
