#pragma once
#include "tests/variants/technique_passes.h"
#include "variants/amd_sssr/mirror.h"

// The passes of variants/amd_sssr/technique.json, as functions of images of a test's own.

struct AmdDenoiserParameters {
    explicit AmdDenoiserParameters(ParameterSet& all) : params(all) {
        add_block(params, "amd_sssr/denoiser_parameters.json");
    }
    ParameterSet& params;
    ParameterView float_histories{params, "float_histories"};
};

struct AmdTracingParameters {
    explicit AmdTracingParameters(ParameterSet& all) : params(all) {
        add_block(params, "amd_sssr/tracing_parameters.json");
    }
    ParameterSet& params;
    Tracers tracers = tracers_of(params, declared_technique("amd_sssr"));
    ParameterView float_roughness{params, "float_roughness"};
};

/// What outlives a frame, by the names that technique.json gives them.
struct AmdHistories {
    PassList::History radiance, variance, sample_count, average_radiance, roughness;
};
AmdHistories amd_histories(PassList& pass_list, bool is_float, bool is_float_roughness);

struct AmdWork {
    Buffer ray_list, tile_list, counters, indirect_arguments;
};

inline float amd_alpha_of_8_bits(float alpha) { return alpha_of_8_bits(alpha); }

AmdWork amd_classify(PassList& pass_list, const GBuffer& gbuffer, const AmdHistories& histories,
                     const Image& confidence, const AmdDenoiserParameters& parameters);
void amd_prepare_arguments(PassList& pass_list, const AmdWork& work, const AmdDenoiserParameters& parameters);
void amd_intersect(PassList& pass_list, const GBuffer& gbuffer, const Tracers::Images& images, const Image& noise,
                   const AmdWork& work, const AmdHistories& histories, const AmdTracingParameters& parameters,
                   RayProbe* probe = nullptr);
void amd_reproject(PassList& pass_list, const GBuffer& gbuffer, const AmdWork& work, const AmdHistories& histories,
                   const AmdDenoiserParameters& parameters);
void amd_prefilter(PassList& pass_list, const AmdWork& work, const AmdHistories& histories,
                   const AmdDenoiserParameters& parameters);
void amd_resolve_temporal(PassList& pass_list, const AmdWork& work, const AmdHistories& histories,
                          const AmdDenoiserParameters& parameters);
void amd_denoise(PassList& pass_list, const GBuffer& gbuffer, const AmdWork& work, const AmdHistories& histories,
                 const AmdDenoiserParameters& parameters);
