#pragma once
#include "core/left_out.h"
#include "core/scene/camera.h"
#include "core/scene/scene.h"
#include "groundtruth/sampling/lobes.h"

#include <memory>
#include <span>
#include <string>
#include <vector>

struct PathTracerSettings {
    unsigned max_depth = 64;  ///< most reflections per path; light that needs more is missing from the estimate
    LightStrategy strategy = LightStrategy::power;
    bool russian_roulette = true;
    bool splitting = true;        ///< of paths that promise much, after expect()
    bool shadow_roulette = true;  ///< of light samples that promise little, after expect(): see shadow_ray_chance()
    ReflectionModel model = ReflectionModel::gltf;
    bool diffuse = true, specular = true;  ///< which parts of a pixel are estimated; `specular` includes `incident`
    bool learns_lights =
        true;  ///< learns which lights reach which places (LightChoice); else groups of lights share the samples
    bool light_clusters = true;  ///< with learns_lights: lights of a group by LightClusters where this is found to pay
    bool mirrored_lamps = true;  ///< light samples also find punctual lights in mirrors: see MirroredLamps
    bool ladder = false;    ///< also estimate the lower rungs of the truth ladder, see PixelEstimate: twice the rays
    bool keep_all = false;  ///< also trace and evaluate what left_out() names: the same image, slower
};

/// The surface that a camera ray through a pixel centre meets, with the quantities of the G-buffer.
struct FirstHit {
    bool is_hit = false;
    glm::vec3 position{0.0f};          ///< m, world space
    float distance = 0.0f;             ///< along the ray (m)
    float depth = 0.0f;                ///< along the view's -z (m)
    glm::vec3 geometric_normal{0.0f};  ///< unit, towards the camera
    glm::vec3 normal{0.0f};            ///< unit shading normal
    glm::vec3 view{0.0f};              ///< unit, towards the camera
    glm::vec3 base_color{0.0f};
    float metalness = 0.0f, roughness = 0.0f, specular = 0.0f;
    glm::vec3 dielectric_f0{0.0f};        ///< see specular_f0()
    unsigned material = 0, instance = 0;  ///< indices into the scene
    glm::vec3 emitted{0.0f};              ///< towards the camera; where nothing is hit, the environment
    glm::vec3 position_error{0.0f};       ///< half extent of the box that holds the exact hit (m)
    glm::vec3 ray_origin{0.0f};           ///< of rays that leave the hit, before their offset along the normal (m)
    bool is_unlit = false;
    glm::vec3 highlight{0.0f};  ///< radiance of the punctual lights that it reflects specularly, without any noise
    unsigned shadow_rays = 0;   ///< traced for `highlight`
    bool is_highlight_finite = true;  ///< else it counts as zero
    // With PathTracerSettings::ladder:
    glm::vec3 reflectance{0.0f};  ///< F0 A + F90 B, as the compositor has it
    glm::vec3 fallback{0.0f};     ///< the environment over the specular lobe, as the G-buffer has it
};

struct LightObservation;
struct RadianceObservation;

/// Sums over the samples of one pixel, to be divided as written here.
struct PixelEstimate {
    /// / samples: diffusely reflected radiance; add FirstHit::emitted for the `diffuse` output
    glm::dvec3 diffuse{0.0};
    glm::dvec3 specular{0.0};  ///< / samples: specularly reflected radiance, without FirstHit::highlight
    glm::dvec3 incident{0.0};  ///< / lobe_samples: mean incident radiance over the lobe above the horizon
    // With PathTracerSettings::ladder:
    glm::dvec3 camera_radiance{0.0};  ///< / lobe_samples: `incident`, with the lit colour of what the lobe meets
    glm::dvec3 on_screen{0.0};  ///< / lobe_samples: the same, with nothing for what the camera's image does not show
    uint64_t on_screen_samples = 0;  ///< samples of the lobe that meet surfaces in the image
    /// / samples: throughput, with the first reflection, that paths had left after max_depth reflections
    glm::dvec3 cut{0.0};
    uint64_t samples = 0;
    uint64_t lobe_samples = 0;  ///< directions of the visible-normal lobe that were above the horizon
    /// Samples with a NaN or an infinity: their parts were added as zero, so an image is valid only if 0.
    uint64_t non_finite = 0;
    uint64_t rays = 0;   ///< traced, of both kinds
    uint64_t paths = 0;  ///< rays that left the first hit along a lobe
    // If given, records of each light sample, and of each path beyond each vertex.
    std::vector<LightObservation>* light_record = nullptr;
    std::vector<RadianceObservation>* radiance_record = nullptr;
};

/// How many light samples and paths of each lobe are one sample of a pixel: 0, or a power of two. An output is the mean
/// over all of its lobe; with 0 it does not change. Outputs share their light samples where both numbers are the same.
struct Directions {
    unsigned diffuse = 1, specular = 1;
};

/// Samples of a pixel with their own scramble, and their sums.
struct SampleBatch {
    uint64_t seed = 0;
    PixelEstimate estimate;
};

/// Unbiased path tracer over Embree (next-event estimation and BSDF sampling combined by multiple importance sampling)
/// for one frame of one camera. The constructor builds the BVH on all cores. After that, const members may be called
/// from any number of threads, and results do not depend on how the work is split.
///
/// `specular` and `incident` leave out light that punctual lights send directly to the first hit. Such lights are
/// deltas: no mean over directions can hold them, no ray meets them, and engines shade them in closed form.
/// FirstHit::highlight has this light. `diffuse` includes it, and so do all outputs at later vertices.
///
/// Surfaces are seen from both sides, except backs that the scene hides (Scene::hides_backs_of()): camera rays,
/// reflections and shadow rays pass these. Normals are turned to the viewer's side, which the geometric normal decides.
/// Camera rays see surfaces between the camera's planes; other rays ignore the planes.
///
/// Where the viewer is below the horizon of the shading normal the surface reflects nothing. Directions below the
/// horizon of the shading normal reflect nothing and are no part of the lobe; directions above it but below the
/// geometric one meet the surface itself and carry no light. Unlit surfaces radiate their base colour and reflect
/// nothing.
class PathTracer {
public:
    /// `scene` must outlive the tracer. Fails with MachineError if Embree runs out of memory.
    PathTracer(const Scene& scene, const ScenePose& pose, const CameraPose& camera, glm::uvec2 extent,
               const PathTracerSettings& settings);
    ~PathTracer();
    PathTracer(const PathTracer&) = delete;
    PathTracer& operator=(const PathTracer&) = delete;

    /// Makes Russian roulette end paths by the light that they are expected to bring to their pixel, not by throughput;
    /// paths that promise much are split, and shadow rays that promise little are left out by chance. `diffuse`,
    /// `specular`: estimates of each pixel (RGB), from other samples than those that are traced afterwards. Means stay
    /// the same. No other member may run at the same time.
    void expect(const HostImage& diffuse, const HostImage& specular);

    /// The hit of the ray through the centre of pixel (x, y), y down.
    FirstHit first_hit(unsigned x, unsigned y) const;

    /// Adds to each batch samples [first_sample, first_sample + count) of the Owen-scrambled Sobol' sequence that (x,
    /// y, seed of the batch) selects. Different seeds give independent scrambles; the error falls fastest when count is
    /// a power of two that divides first_sample. Unlit hits and the background have nothing to estimate: only `samples`
    /// grows. Paths of all batches are in flight together, so one call with several batches takes less time. Each batch
    /// gets the same samples as alone, but sums may be added in another order. (first_sample + count) times the
    /// directions of either lobe is at most 2^32.
    void trace(unsigned x, unsigned y, const FirstHit& hit, unsigned first_sample, unsigned count,
               std::span<SampleBatch> batches, Directions directions = {}) const;
    /// The same for one batch.
    void trace(unsigned x, unsigned y, const FirstHit& hit, uint64_t seed, unsigned first_sample, unsigned count,
               PixelEstimate& estimate) const;

    /// Parts that this scene does not need; none with PathTracerSettings::keep_all.
    const std::vector<LeftOut>& left_out() const;

private:
    void learn_light_choice();
    template <class Observation>
    std::vector<Observation> learn(uint64_t seed, unsigned wanted_samples,
                                   std::vector<Observation>* PixelEstimate::*record) const;

    struct State;
    std::unique_ptr<State> state_;
};
