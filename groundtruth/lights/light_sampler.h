#pragma once
#include "groundtruth/lights/environment_table.h"
#include "groundtruth/lights/light_choice.h"
#include "groundtruth/lights/light_clusters.h"
#include "groundtruth/lights/mirrored_lamps.h"
#include "groundtruth/lights/punctual_arrival.h"
#include "groundtruth/sampling/lanes.h"
#include "groundtruth/scene/material_table.h"

#include <optional>

/// Directions in which light may arrive at a point per lane, before visibility is known.
struct LightLanes {
    LanesVec3 direction;  ///< unit, towards the light
    LanesVec3 radiance;   ///< for a delta light: irradiance at normal incidence; else W sr^-1 m^-2; see arriving() for
                          ///< a mirrored lamp
    Lanes<float>
        pdf;  ///< sr^-1, times the probability of the choice; for a delta light: that probability; 0: no sample
    LanesVec3 position, error,
        normal;  ///< of the point on the light, unless infinite; a punctual light has neither error nor normal
    Lanes<uint32_t> is_delta, is_infinite;
    Lanes<uint32_t> group;  ///< group number of LightChoice
    Lanes<uint32_t> light;  ///< index in the group, see LightClusters::Choice; 0 for the environment and mirrored lamps
    // Rays that test visibility, filled in by aim_shadow_ray():
    LanesVec3 shadow_origin, shadow_direction;
    Lanes<float> shadow_far;  ///< in units of shadow_direction
};

/// Chooses among emissive triangles, punctual lights, the environment and mirrored lamps: a group by LightChoice, and a
/// light of it in proportion to power, or by LightClusters where learning finds that this pays. Groups are neighbouring
/// triangles, neighbouring lamps (each its own, if there are few), the parts of the environment, and each mirrored
/// lamp.
class LightSampler {
public:
    /// `sample_environment`: also sample a constant or gradient one, which BSDF sampling finds as well. `compensate`:
    /// see EnvironmentTable. `mirror_lamps`: also sample the images of lamps in mirrors.
    LightSampler(const Scene& scene, const ScenePose& pose, const EmbreeScene& geometry, const MaterialTable& materials,
                 bool sample_environment, bool compensate, bool mirror_lamps);

    bool empty() const { return group_count() == 0; }
    uint32_t group_count() const { return first_image_ + mirrored_.count(); }
    /// See LightChoice::learn(). Also decides which mirrored lamps are sampled and, with `may_cluster`, which groups
    /// use LightClusters. Call it once.
    void learn(std::vector<LightObservation> observations, bool may_cluster);
    /// The cells of all that is learnt of the scene.
    const LearningGrid& grid() const { return grid_; }
    const LightChoice& choice() const { return choice_; }
    const std::vector<PunctualLight>& punctual_lights() const { return lights_; }  ///< those that shine
    bool has_environment_table() const { return environment_.part_count() > 0; }
    const MirroredLamps& mirrored_lamps() const { return mirrored_; }
    /// The image of a lamp that a group is, or MirroredLamps::none.
    uint32_t image(uint32_t group) const { return group < first_image_ ? MirroredLamps::none : group - first_image_; }

    /// `x`, `y`: 2-D uniform, 32-bit fixed point. `point`: where the light arrives; `cell`: its cell. The sampler must
    /// not be empty(). Lanes that are not wanted get anything.
    void sample(const Lanes<uint32_t>& is_wanted, const LanesVec3& point, const Lanes<uint32_t>& cell,
                const Lanes<uint32_t>& x, const Lanes<uint32_t>& y, LightLanes& lights) const;

    /// Density (sr^-1) with which sample() finds a point of an emissive triangle along `direction` at `distance` (m)
    /// from `point` (m) of `cell`.
    float triangle_pdf(uint32_t cell, glm::vec3 point, uint32_t instance, uint32_t triangle, glm::vec3 normal,
                       glm::vec3 direction, float distance) const;
    /// The same (sr^-1) for a direction of environment(), of which a place is given.
    float environment_pdf(uint32_t cell, glm::vec2 place) const;
    /// The same (sr^-1) for a direction from `point` to the image in `mirror` of a lamp, the light of `group`.
    float image_pdf(uint32_t cell, glm::vec3 point, glm::vec3 direction, uint32_t mirror, uint32_t group,
                    uint32_t light) const;
    /// Only where has_environment_table().
    const EnvironmentTable& environment() const { return environment_; }

private:
    static constexpr uint32_t no_light = ~0u, no_group = ~0u;

    struct Triangle {
        glm::vec3 position[3];
        glm::vec3 error;  ///< half extent of a box that holds the exact place of any of its points
        glm::vec3 front_normal;
        glm::vec3 radiance;  ///< constant emission
        float per_area;      ///< 1 / area (m^-2)
        uint32_t instance, triangle;
        uint32_t group = no_group, place = 0;  ///< its group, and its index there
        bool emission_varies, emits_behind;
    };
    /// Lights that are chosen together, as indices of triangles_, then lights_.
    struct Group {
        std::vector<uint32_t> lights;
        AliasTable table;                       ///< by power
        std::optional<LightClusters> clusters;  ///< instead of the table

        LightClusters::Choice sample(glm::vec3 point, uint32_t bits) const;
        float probability(uint32_t place, glm::vec3 point) const;  ///< with which sample() chooses lights[place]
    };

    void add_triangles(const Scene& scene, uint32_t instance);
    void group_lights(float diagonal);
    std::vector<double> shares() const;
    void add_group(std::vector<uint32_t> lights);
    void cluster_groups(std::span<const LightObservation> observations);
    void drop_images(std::vector<LightObservation>& observations);
    void sample_environment(uint32_t lanes, const Lanes<uint32_t>& x, const Lanes<uint32_t>& y,
                            const Lanes<float>& probability, LightLanes& lights) const;
    void sample_punctual(const PunctualLight& light, glm::vec3 point, float probability, int lane,
                         LightLanes& lights) const;
    void sample_image(uint32_t image, glm::vec3 point, glm::vec2 u, float probability, int lane,
                      LightLanes& lights) const;

    const EmbreeScene& geometry_;
    const MaterialTable& materials_;
    std::vector<Triangle> triangles_;
    uint32_t triangle_count_ = 0;
    std::vector<uint32_t> first_triangle_;  ///< of each instance, or no_light
    std::vector<PunctualLight> lights_;
    std::vector<LightExtent> extents_;  ///< of triangles_, then lights_
    EnvironmentTable environment_;
    MirroredLamps mirrored_;
    uint32_t first_image_ = 0;   ///< group of the first of mirrored_
    bool needs_more_ = false;    ///< there is more to sample than triangles of constant emission
    std::vector<Group> groups_;  ///< LightChoice counts these, then the parts of environment_, then mirrored_
    LightChoice choice_;
    LearningGrid grid_;
};
