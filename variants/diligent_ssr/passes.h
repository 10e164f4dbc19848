#pragma once
#include "core/gbuffer/gbuffer.h"
#include "core/gpu/passes/pass_graph.h"
#include "variants/diligent_ssr/filter_parameters.h"
#include "variants/diligent_ssr/tracing_parameters.h"

// The passes of DiligentFX's screen-space reflection in their order: draws of a triangle over the whole image, nothing
// that WebGL 2 lacks. Each adds its draws to the graph; tests run them one by one. Names of images are those that the
// shaders of this folder use.

/// Which pixels later passes draw: a depth or stencil buffer per resolution. Pixels that it leaves out keep what their
/// targets held.
struct DiligentMask {
    Image roughness;  ///< perceptual, of the pixels kept; r8, or r32f with float_roughness. Elsewhere older frames'
                      ///< (0 at first), or 1 with clear_targets
    Image full;       ///< d16 or d32f_s8, of the screen
    Image traced;     ///< of the resolution of the rays; `full` without half_resolution
};

/// What the rays found, at their resolution; black where no ray is.
struct DiligentRays {
    Image radiance;   ///< rgb colour at the hit (with premultiply_confidence times confidence), a confidence
    Image direction;  ///< xyz world-space direction times length (m), w density of the direction (sr^-1)
};

/// What eight neighbours' rays make of each pixel.
struct DiligentResolved {
    Image radiance;   ///< rgb, a confidence
    Image variance;   ///< of the luminance
    Image hit_depth;  ///< device depth of the mirrored point, or its distance from the camera plane (m) with
                      ///< linear_hit_depth
};

/// What outlives a frame; black in the first.
struct DiligentHistories {
    PassGraph::History radiance, variance;
};

DiligentHistories diligent_histories(PassGraph& graph, const DiligentFilterParameters& parameters);

/// Device depth of each pixel's point as the previous camera saw it: `reprojected_depth`, r32f. With
/// guard_previous_clip that of the near plane for points that were behind the camera.
Image diligent_reprojected_depth(PassGraph& graph, const GBuffer& gbuffer);

/// The pyramids that parameters.tracers need. Mip 0 is gbuffer.depth, each following texel the nearest (or farthest) of
/// the 2x2 below, or of three where the level below is odd. One draw per mip.
Tracers::Images diligent_depth_hierarchies(PassGraph& graph, const GBuffer& gbuffer,
                                           const DiligentTracingParameters& parameters);

/// Keeps surfaces that reflect and are no rougher than roughness_threshold.
DiligentMask diligent_mask(PassGraph& graph, const GBuffer& gbuffer, const DiligentTracingParameters& tracing,
                           const DiligentFilterParameters& filter);

/// The perceptual roughness that the mask compares with the threshold, unless float_roughness is on.
float diligent_roughness_of_8_bits(float perceptual);

/// One ray per kept pixel of mask.traced. `noise`: 128x128, two channels in [0, 1]. `color`: lit image that hits show;
/// of the previous frame with previous_frame.
DiligentRays diligent_trace(PassGraph& graph, const GBuffer& gbuffer, const Tracers::Images& hierarchies,
                            const Image& noise, const Image& color, const DiligentMask& mask,
                            const DiligentTracingParameters& parameters, RayProbe* probe = nullptr);

DiligentResolved diligent_reconstruct(PassGraph& graph, const GBuffer& gbuffer, const DiligentRays& rays,
                                      const DiligentMask& mask, const DiligentFilterParameters& parameters);

/// Writes the current sides of the histories.
void diligent_accumulate(PassGraph& graph, const GBuffer& gbuffer, const Image& reprojected_depth,
                         const DiligentResolved& resolved, const DiligentHistories& histories, const DiligentMask& mask,
                         const DiligentFilterParameters& parameters);

/// The image `reflections`, rgba32f with float_histories, else rgba16f: rgb radiance, a confidence; black where the
/// mask leaves out. `radiance`, `variance`: of the stage before.
Image diligent_cleanup(PassGraph& graph, const GBuffer& gbuffer, const Image& radiance, const Image& variance,
                       const DiligentMask& mask, const DiligentFilterParameters& parameters);

/// A colour target of masked passes: cleared in each frame, or only when it is new, so that the pixels which the mask
/// leaves out keep what older frames wrote.
Image diligent_target(PassGraph& graph, const std::string& name, Format format, glm::uvec2 extent, bool is_cleared);

/// Draws the pixels that the shader does not discard into `mask`, which has been cleared to 0; for a mask by depth the
/// shader writes gl_FragDepth = 1.
void draw_mask(PassGraph::Pass& pass, const Image& mask);

/// Draws only the pixels that `mask` (DiligentMask::full or ::traced) keeps.
void draw_masked(PassGraph::Pass& pass, const Image& mask);
