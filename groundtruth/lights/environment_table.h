#pragma once
#include "core/scene/scene.h"
#include "groundtruth/sampling/alias_table.h"

/// Draws directions of an environment by parts. A part is a connected region of the sky: a window may show some parts
/// and hide others. Within a part the density is proportional to luminance, from a table over latitude and longitude
/// (Pharr, Jakob and Humphreys 2023, "Physically Based Rendering", section 12.5). Constants and gradients are drawn
/// evenly.
class EnvironmentTable {
public:
    EnvironmentTable() = default;
    /// `compensate` lowers the density where BSDF sampling does well (Karlik et al. 2019, "MIS Compensation"):
    /// directions dimmer than the mean are then never drawn, so it must not be used without BSDF sampling.
    EnvironmentTable(const Environment& environment, bool compensate);

    uint32_t part_count() const { return uint32_t(parts_.size()); }  ///< 0: nothing to draw
    double mean_luminance() const { return mean_luminance_; }        ///< over the sphere

    /// A unit direction of a part; pdf in sr^-1, given the part.
    glm::vec3 sample(uint32_t part, glm::uvec2 bits, float& pdf) const;
    struct Density {
        uint32_t part;
        float pdf;  ///< with which sample() draws the direction, given the part (sr^-1)
    };
    Density density(glm::vec3 direction) const;  ///< of a unit direction

private:
    struct Part {
        std::vector<uint32_t> cells;
        AliasTable table;
    };
    unsigned width_ = 0, height_ = 0;  ///< cells in longitude and latitude
    glm::vec2 cell_extent_{0.0f};      ///< in uv
    float rotation_ = 0;
    std::vector<Part> parts_;
    std::vector<Density> density_;  ///< of each cell
    double mean_luminance_ = 0;
};
