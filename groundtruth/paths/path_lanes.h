#pragma once
#include "groundtruth/paths/traced_scene.h"
#include "groundtruth/sampling/lanes.h"
#include "groundtruth/sampling/sobol.h"

/// Pairs of the Sobol' point that the first hit uses; each later vertex takes the next two of its path's stream.
enum : uint32_t { pair_specular, pair_light, pair_diffuse, pair_first_free };
inline constexpr uint32_t pairs_per_vertex = 2;
inline constexpr uint32_t diffuse_stream = 1u << 16;  ///< pairs of the paths that leave along the diffuse lobe

/// A path that leaves the first hit.
struct PathStart {
    PixelEstimate* estimate;  ///< gets the path's light; outlives PathLanes::finish()
    SobolSequence sequence;   ///< of its batch
    glm::vec3 origin, direction;
    glm::vec3 weight;          ///< f mu_i / pdf of its lobe
    float pdf;                 ///< sr^-1, of its lobe
    uint32_t light_cell;       ///< of the first hit: see LightChoice::cell()
    uint32_t reversed_sample;  ///< the index of the sample, bits reversed
    bool is_specular;          ///< it leaves along the specular lobe, else the diffuse one
    /// 1 / expected luminance of this lobe in the pixel: roulette ends paths that promise little of it. 0: roulette by
    /// throughput.
    float per_estimate;
};

/// The outputs that paths estimate.
enum class PathGoal {
    reflection,  ///< light that the first hit reflects: `specular` and `incident`, or `diffuse`
    lit_color    ///< the lit colour of the surface that the path meets first: `camera_radiance` and `on_screen`
};

/// Paths in flight, of any batches. A lane whose path has ended takes the next one, so that all lanes stay busy until
/// finish().
class PathLanes {
public:
    PathLanes(const TracedScene& scene, PathGoal goal);

    void start(const PathStart& path);
    void finish();

private:
    void advance();
    void trace_rays();
    void leave(uint32_t lanes);
    void meet(int lane, const RTCRayHit& ray);
    void sample_lights();
    template <bool has_dielectric_f0>
    void scatter();
    void weigh_images(uint32_t reached);
    template <bool has_lights, PathGoal goal, bool has_dielectric_f0>
    void scatter();
    void trace_shadow_rays(uint32_t reached);
    void look_ahead();
    void split(int lane, float wanted_parts);
    void resume_branches();
    void record(uint32_t continuing);
    void end(int lane);

    SobolSequence sequence(int lane) const { return {seed_a_[lane], seed_b_[lane]}; }

    static constexpr uint32_t all_lanes = (1ull << lane_count) - 1;  ///< bit per lane

    /// A part of a path that was split, at the vertex from which it is to go on.
    struct Branch {
        PixelEstimate* estimate;
        SobolSequence sequence;
        vec3 direction, throughput, weight, position, error, geometric_normal, normal, base_color, dielectric_f0;
        float metalness, roughness, specular, per_estimate, promise, part;
        uint32_t depth, pair, reversed_sample, is_specular, learnt_index;
    };

    struct Visit {
        vec3 position, normal;
        float throughput, radiance;  ///< luminance, when the path went on
    };

    const TracedScene& scene_;
    const PathGoal goal_;
    const bool has_lights_, has_images_;      ///< light samples find lights; and lamps in mirrors
    uint32_t busy_ = 0;                       ///< bit per lane: it holds a path
    uint32_t resumed_ = 0;                    ///< bit per lane: its path is a branch that stands at its vertex
    std::vector<Branch> branches_;            ///< that wait for a lane
    bool records_ = false;                    ///< observations of paths are recorded
    std::vector<std::vector<Visit>> visits_;  ///< of each lane, while it is

    // The path of each lane:
    PixelEstimate* estimate_[lane_count] = {};
    Lanes<uint32_t> seed_a_, seed_b_;  ///< of its sequence
    LanesVec3 origin_, direction_, throughput_, radiance_, weight_;
    Lanes<float> pdf_;            ///< with which direction_ was drawn
    Lanes<uint32_t> light_cell_;  ///< of the last vertex that took a light sample
    Lanes<uint32_t> last_cell_;   ///< of the vertex before it
    Lanes<uint32_t> depth_, pair_, reversed_sample_, is_specular_;
    Lanes<float> per_estimate_;
    Lanes<uint32_t> is_on_screen_;  ///< what it met first
    // The vertex that each path has reached:
    Lanes<uint32_t> continues_;  ///< 1 if there is one, and later if the path goes on from it, else 0
    LanesVec3 position_, error_, geometric_normal_, normal_, base_color_, dielectric_f0_;
    Lanes<float> metalness_, roughness_, specular_;
    Lanes<uint32_t> learnt_index_;  ///< of LightSampler::grid()
    Lanes<uint32_t> mirror_;        ///< see MirroredLamps
    LightLanes lights_;
    Lanes<float> mirrored_weight_;  ///< of the light sample's specular part
    Lanes<float> rarity_;           ///< see LightObservation
    LanesVec3 direct_;              ///< what the light sample adds, if it is visible
    Lanes<float>
        promise_;  ///< expected light of a path of weight 1 beyond the vertex, relative to the pixel's; 0: unknown
    Lanes<float> part_;  ///< part of the path that goes on in this lane: below 1 if it was split here
    LanesVec3 cut_;      ///< throughput of the path beyond max_depth, if it went on
};
