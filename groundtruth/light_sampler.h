#pragma once
#include "groundtruth/alias_table.h"
#include "groundtruth/environment_table.h"
#include "groundtruth/lanes.h"
#include "groundtruth/material_table.h"

/// Directions in which light may arrive at a point per lane, before visibility is known.
struct LightLanes {
    LanesVec3 direction;  ///< unit, towards the light
    LanesVec3 radiance;   ///< of a delta light: irradiance at normal incidence; W sr^-1 m^-2 else
    Lanes<float> pdf;  ///< sr^-1, times the probability of the choice; of a delta light: that probability; 0: no sample
    LanesVec3 position, error,
        normal;  ///< of the point on the light, if not infinite; a punctual light has no error and no normal
    Lanes<uint32_t> is_delta, is_infinite;
    // Of the rays that test visibility, filled in by aim_shadow_rays():
    LanesVec3 shadow_origin, shadow_direction;
    Lanes<float> shadow_far;  ///< in units of shadow_direction
};

/// What a punctual light sends to a point, before visibility is known.
struct PunctualArrival {
    glm::vec3 direction;   ///< unit, towards the light; not a number if the point is the light's own
    glm::vec3 irradiance;  ///< at normal incidence (W m^-2)
    bool is_infinite;      ///< the light is at no place
};
PunctualArrival arrival(const PunctualLight& light, glm::vec3 point);

/// Chooses among emissive triangles, punctual lights and the environment with probability proportional to their power.
class LightSampler {
public:
    /// `sample_environment`: also where it is constant or a gradient, which BSDF sampling finds as well.
    /// `compensate`: see EnvironmentTable.
    LightSampler(const Scene& scene, const ScenePose& pose, const EmbreeScene& geometry, const MaterialTable& materials,
                 bool sample_environment, bool compensate);

    bool empty() const { return table_.empty(); }
    const std::vector<PunctualLight>& punctual_lights() const { return lights_; }  ///< that shine
    bool has_emitters() const { return !triangles_.empty(); }
    bool has_environment_table() const { return environment_index_ != none; }

    /// `x`, `y`: 2-D uniform, 32-bit fixed point. `point`: where the light arrives. The sampler must not be empty().
    /// Lanes that are not wanted get anything.
    void sample(const Lanes<uint32_t>& is_wanted, const LanesVec3& point, const Lanes<uint32_t>& x,
                const Lanes<uint32_t>& y, LightLanes& lights) const;

    /// Density (sr^-1) with which sample() finds a point of an emissive triangle along `direction` at `distance` (m).
    float triangle_pdf(uint32_t instance, uint32_t triangle, glm::vec3 normal, glm::vec3 direction,
                       float distance) const;
    float environment_pdf(glm::vec3 direction) const;

private:
    struct Triangle {
        glm::vec3 position[3];
        glm::vec3 error;  ///< half extent of a box that holds the exact place of any of its points
        glm::vec3 front_normal;
        glm::vec3 radiance;  ///< constant emission
        float area_pdf;      ///< probability of the choice over the area (m^-2)
        uint32_t instance, triangle;
        bool emission_varies, emits_behind;
    };
    static constexpr size_t none = size_t(-1);
    static constexpr uint32_t no_light = ~0u;

    void add_triangles(const Scene& scene, uint32_t instance, std::vector<double>& powers);
    void sample_environment(uint32_t x, uint32_t y, int lane, LightLanes& lights) const;
    void sample_punctual(const PunctualLight& light, glm::vec3 point, float probability, int lane,
                         LightLanes& lights) const;

    const EmbreeScene& geometry_;
    const MaterialTable& materials_;
    std::vector<Triangle> triangles_;
    uint32_t triangle_count_ = 0;
    std::vector<uint32_t> first_triangle_;  ///< of each instance, or no_light
    std::vector<PunctualLight> lights_;
    EnvironmentTable environment_;
    const Environment* environment_source_ = nullptr;
    float environment_probability_ = 0;
    bool needs_more_ = false;  ///< there is more to sample than triangles of constant emission
    size_t environment_index_ = none;
    AliasTable table_;  ///< over triangles_, lights_, and the environment
};
