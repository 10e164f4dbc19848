#pragma once
#include "core/gbuffer/gbuffer.h"
#include "core/gpu/passes/pass_graph.h"
#include "variants/amd_sssr/denoiser_parameters.h"
#include "variants/amd_sssr/tracing_parameters.h"

// The passes of AMD FidelityFX SSSR in their order. Each adds its dispatches to the graph; tests run them one by one.
// Names of images and buffers are those that the shaders of this folder use.

/// What outlives a frame. As in the original two images of each kind take turns, and passes of one frame use both: see
/// amd_denoise().
struct AmdHistories {
    PassGraph::History radiance;          ///< rgb W sr^-1 m^-2; w length of the ray (m) until the denoiser drops it
    PassGraph::History variance;          ///< squared relative change of luminance
    PassGraph::History sample_count;      ///< frames
    PassGraph::History average_radiance;  ///< one texel per 8x8 tile, rounded up
    PassGraph::History roughness;         ///< alpha
};

/// Images of the graph's extent, black in the first frame. `is_float`: all but roughness in 32 bits per channel, where
/// the original has 16 (11, 11, 10 for averages); `is_float_roughness`: alpha in 32 in place of 8 bits.
AmdHistories amd_histories(PassGraph& graph, bool is_float, bool is_float_roughness);

/// The alpha that 8 bits make of one: what pixels are rated by with rate_stored_roughness, unless float_roughness is
/// on.
float amd_alpha_of_8_bits(float alpha);

/// What classification found to do, and the indirect arguments that start it.
struct AmdWork {
    /// Bits 0-14 x, 15-28 y; copy to a neighbour in the quad: 29 the horizontal, 30 the vertical, 31 the diagonal one.
    Buffer ray_list;
    Buffer tile_list;  ///< of 8x8 pixels to denoise: y << 16 | x of the first pixel
    Buffer counters;   ///< rays being listed, rays, tiles being listed, tiles
    /// Groups to intersect (3 words); to denoise a tile each (at byte 12); to denoise eight tiles each (24).
    Buffer indirect_arguments;
};

/// Lists rays and tiles; writes alpha, clears histories.radiance.current (environment where too rough) and writes
/// `confidence`: 1 where the technique is responsible. `parameters`: denoiser_form decides the order of the lists, too.
AmdWork amd_classify(PassGraph& graph, const GBuffer& gbuffer, const AmdHistories& histories, const Image& confidence,
                     const AmdDenoiserParameters& parameters);

/// Turns counters into indirect arguments and rewinds them.
void amd_prepare_arguments(PassGraph& graph, const AmdWork& work);

/// Traces the listed rays into histories.radiance.current. `noise`: 128x128, two channels in [0, 1]. `images`: of
/// parameters.tracers.
void amd_intersect(PassGraph& graph, const GBuffer& gbuffer, const Tracers::Images& images, const Image& noise,
                   const AmdWork& work, const AmdHistories& histories, const AmdTracingParameters& parameters,
                   RayProbe* probe = nullptr);

/// Reproject reads radiance.previous, variance.previous, sample_count.previous, roughness.previous and writes their
/// current sides, `reprojected_radiance` and average_radiance.current; prefilter then overwrites radiance.previous and
/// variance.previous; resolve overwrites radiance.current and variance.current, which the next frame sees as history.
void amd_denoise(PassGraph& graph, const GBuffer& gbuffer, const AmdWork& work, const AmdHistories& histories,
                 const AmdDenoiserParameters& parameters);

/// Why its results may differ from run to run, as Variant::not_repeatable() says it.
std::string amd_denoiser_not_repeatable(const AmdDenoiserParameters& parameters);

/// What the shaders of the form that parameters choose include: how moments are summed.
ShaderIncludes amd_denoiser_includes(const AmdDenoiserParameters& parameters);

// Its three passes, in their order.
void amd_reproject(PassGraph& graph, const GBuffer& gbuffer, const AmdWork& work, const AmdHistories& histories,
                   const AmdDenoiserParameters& parameters);
void amd_prefilter(PassGraph& graph, const AmdWork& work, const AmdHistories& histories,
                   const AmdDenoiserParameters& parameters);
void amd_resolve_temporal(PassGraph& graph, const AmdWork& work, const AmdHistories& histories,
                          const AmdDenoiserParameters& parameters);
