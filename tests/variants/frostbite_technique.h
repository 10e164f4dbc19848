#pragma once
#include "tests/variants/technique_passes.h"
#include "variants/denoisers/denoiser.h"

// The passes of variants/frostbite_sssr/technique.json, as functions of images of a test's own.

/// Those of variants/denoisers/ray_draw.json.
struct RayDrawParameters {
    explicit RayDrawParameters(ParameterSet& all) : RayDrawParameters(all, "denoisers/ray_draw.json") {}

    ParameterSet& params;
    ParameterView half_resolution{params, "half_resolution"}, max_roughness{params, "max_roughness"},
        max_rays{params, "max_rays"}, lobe{params, "lobe"}, importance_bias{params, "importance_bias"};

protected:
    RayDrawParameters(ParameterSet& all, const std::string& block) : params(all) { add_block(params, block); }
};

struct FrostbiteRayParameters : RayDrawParameters {
    explicit FrostbiteRayParameters(ParameterSet& all) : RayDrawParameters(all, "frostbite_sssr/ray_parameters.json") {}
    Tracers tracers = tracers_of(params, declared_technique("frostbite_sssr"));
};

struct FrostbiteResolveParameters {
    explicit FrostbiteResolveParameters(ParameterSet& all) : params(all) {
        add_block(params, "frostbite_sssr/resolve_parameters.json");
    }
    ParameterSet& params;
    ParameterView cone_scale{params, "cone_scale"}, grazing_cone{params, "grazing_cone"},
        reuse_jacobian{params, "reuse_jacobian"}, previous_frame{params, "previous_frame"},
        filtered_sampling{params, "filtered_sampling"}, neighbor_ray{params, "neighbor_ray"}, misses{params, "misses"},
        estimator{params, "estimator"}, reflection_depth{params, "reflection_depth"};
};

/// Size of a tile of the classification and distance of its probes (pixels).
inline constexpr unsigned frostbite_tile = 32, frostbite_probe_spacing = 8;

struct FrostbiteTiles {
    Image ray_count;
};
struct FrostbiteWork {
    Buffer smooth_list, rough_list, counters, indirect_arguments;
    glm::uvec2 extent;  ///< traced pixels: of the screen, or half of it, rounded up
};
struct FrostbiteResolved {
    Image radiance, reflection_depth;
};

Image frostbite_color_pyramid(PassList& pass_list, const Image& color);
FrostbiteTiles frostbite_classify(PassList& pass_list, const GBuffer& gbuffer, const Tracers::Images& images,
                                  const Image& color, const FrostbiteRayParameters& parameters,
                                  RayProbe* probe = nullptr);
FrostbiteWork frostbite_allocate(PassList& pass_list, const GBuffer& gbuffer, const FrostbiteTiles& tiles,
                                 const FrostbiteRayParameters& parameters);
TracedRays frostbite_trace(PassList& pass_list, const Tracers::Images& images, const FrostbiteWork& work,
                           const Image& below_horizon, const FrostbiteRayParameters& parameters,
                           RayProbe* probe = nullptr);
FrostbiteResolved frostbite_resolve(PassList& pass_list, const GBuffer& gbuffer, const Image& color,
                                    const Image& split_sum, const Image& below_horizon, const TracedRays& rays,
                                    const FrostbiteResolveParameters& parameters);
Image frostbite_accumulate(PassList& pass_list, const GBuffer& gbuffer, const Image& split_sum,
                           const FrostbiteResolved& resolved, const FrostbiteResolveParameters& parameters);
