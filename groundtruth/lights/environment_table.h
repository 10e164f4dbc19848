#pragma once
#include "core/scene/scene.h"
#include "groundtruth/sampling/alias_table.h"

/// Draws directions of an environment by parts. A part is a connected region of the sky: a window may show some parts
/// and hide others. Within a part the density is proportional to luminance, from a table over latitude and longitude
/// (Pharr, Jakob and Humphreys 2023, "Physically Based Rendering", section 12.5). Constants and gradients are drawn
/// evenly.
///
/// Tables and images are larger than caches. Each step of a lookup therefore prefetches what the next step reads, so
/// that lookups of several lanes, made step by step, wait together.
class EnvironmentTable {
public:
    EnvironmentTable() = default;
    /// `environment` must outlive the table. `compensate` lowers the density where BSDF sampling does well (Karlik et
    /// al. 2019, "MIS Compensation"): directions dimmer than the mean are then never drawn, so it must not be used
    /// without BSDF sampling.
    EnvironmentTable(const Environment& environment, bool compensate);

    uint32_t part_count() const { return uint32_t(parts_.size()); }  ///< 0: nothing to draw

    // The steps to draw a direction of a part, from uniform `bits`:
    void prefetch(uint32_t part, glm::uvec2 bits) const { parts_[part].table.prefetch(bits.x); }
    AliasTable::Choice choose(uint32_t part, glm::uvec2 bits) const;
    /// environment_uv() of the direction; pdf in sr^-1, given the part.
    glm::vec2 place(uint32_t part, AliasTable::Choice choice, glm::uvec2 bits, float& pdf) const;

    // The steps to look a unit direction up:
    glm::vec2 place(glm::vec3 direction) const;  ///< its environment_uv()
    struct Density {
        uint32_t part;
        float pdf;  ///< with which the direction is drawn, given the part (sr^-1)
    };
    Density density(glm::vec2 uv) const { return density_[cell(uv)]; }

    glm::vec3 direction(glm::vec2 uv) const;                      ///< unit
    glm::vec3 radiance(glm::vec2 uv, glm::vec3 direction) const;  ///< of the environment

private:
    struct Cell {
        uint32_t index;
        float pdf;  ///< see Density
    };
    struct Part {
        std::vector<Cell> cells;
        AliasTable table;
    };
    size_t cell(glm::vec2 uv) const;
    void prefetch_radiance(glm::vec2 uv) const;

    const Environment* environment_ = nullptr;
    unsigned width_ = 0, height_ = 0;  ///< cells in longitude and latitude
    glm::vec2 cell_extent_{0.0f};      ///< in uv
    std::vector<Part> parts_;
    std::vector<Density> density_;  ///< of each cell
};
