#pragma once
#include "tests/variants/technique_passes.h"

// The passes of variants/diligent_ssr/technique.json, as functions of images of a test's own.

struct DiligentFilterParameters {
    explicit DiligentFilterParameters(ParameterSet& all) : params(all) {
        add_block(params, "diligent_ssr/filter_parameters.json");
    }
    ParameterSet& params;
    ParameterView float_histories{params, "float_histories"}, linear_hit_depth{params, "linear_hit_depth"};
};

struct DiligentTracingParameters {
    explicit DiligentTracingParameters(ParameterSet& all) : params(all) {
        add_block(params, "diligent_ssr/tracing_parameters.json");
    }
    ParameterSet& params;
    Tracers tracers = tracers_of(params, declared_technique("diligent_ssr"));
    ParameterView float_rays{params, "float_rays"}, previous_frame{params, "previous_frame"};
};

struct DiligentMask {
    Image roughness, full, traced;  ///< `full` and `traced` are one without half_resolution
};
struct DiligentRays {
    Image radiance, direction;
};
struct DiligentResolved {
    Image radiance, variance, hit_depth;
};
struct DiligentHistories {
    PassList::History radiance, variance;
};

inline float diligent_roughness_of_8_bits(float perceptual) { return roughness_of_8_bits(perceptual); }

DiligentHistories diligent_histories(PassList& pass_list, const DiligentFilterParameters& parameters);
Image diligent_reprojected_depth(PassList& pass_list, const GBuffer& gbuffer);
Tracers::Images diligent_depth_hierarchies(PassList& pass_list, const GBuffer& gbuffer,
                                           const DiligentTracingParameters& parameters);
DiligentMask diligent_mask(PassList& pass_list, const GBuffer& gbuffer, const DiligentTracingParameters& tracing,
                           const DiligentFilterParameters& filter);
DiligentRays diligent_trace(PassList& pass_list, const GBuffer& gbuffer, const Tracers::Images& hierarchies,
                            const Image& noise, const Image& color, const DiligentMask& mask,
                            const DiligentTracingParameters& parameters, RayProbe* probe = nullptr);
DiligentResolved diligent_reconstruct(PassList& pass_list, const GBuffer& gbuffer, const DiligentRays& rays,
                                      const DiligentMask& mask, const DiligentFilterParameters& parameters);
void diligent_accumulate(PassList& pass_list, const GBuffer& gbuffer, const Image& reprojected_depth,
                         const DiligentResolved& resolved, const DiligentHistories& histories, const DiligentMask& mask,
                         const DiligentFilterParameters& parameters);
Image diligent_cleanup(PassList& pass_list, const GBuffer& gbuffer, const Image& radiance, const Image& variance,
                       const DiligentMask& mask, const DiligentFilterParameters& parameters);

/// Draws only the pixels that `mask` keeps.
void draw_masked(PassList::Pass& pass, const Image& mask);
