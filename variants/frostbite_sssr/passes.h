#pragma once
#include "core/gbuffer/gbuffer.h"
#include "core/gpu/passes/pass_graph.h"
#include "variants/frostbite_sssr/ray_parameters.h"
#include "variants/frostbite_sssr/resolve_parameters.h"
#include "variants/resolves/traced_rays.h"

// The passes of Frostbite's stochastic reflections in their order. Each adds its dispatches to the graph; tests run
// them one by one. Names of images and buffers are those that the shaders of this folder use.

/// Size of a tile of the classification and distance of its probes (pixels).
inline constexpr unsigned frostbite_tile = 32, frostbite_probe_spacing = 8;

/// How many rays each tile gets.
struct FrostbiteTiles {
    Image ray_count;  ///< r32f, one texel per tile, rounded up: rays of each of its traced pixels, 0: skipped
};

/// Rays to trace, by tracer, and the indirect arguments that start both.
struct FrostbiteWork {
    Buffer smooth_list, rough_list;            ///< index of the ray: (y * width + x) * max_rays + k, in traced pixels
    Buffer counters;                           ///< lengths of both
    Buffer indirect_arguments;                 ///< groups of 64 rays: smooth (3 words), rough (at byte 12)
    bool has_smooth = true, has_rough = true;  ///< whether the lists may hold rays at all
    glm::uvec2 extent;                         ///< traced pixels: of the screen, or half of it, rounded up
};

/// What each pixel makes of its own and its neighbours' rays.
struct FrostbiteResolved {
    Image radiance;          ///< rgba32f: rgb incident radiance (times reflectance without reflectance_after_filter), a
                             ///< confidence
    Image reflection_depth;  ///< r32f: length of the resolved rays (m); 0: none
};

/// `color` and all its mips, each texel the mean over its area, also where sizes are odd: `color_pyramid`, rgba32f.
Image frostbite_color_pyramid(PassGraph& graph, const Image& color);

/// Probes and the decision per tile. `images`: of parameters.tracers.
FrostbiteTiles frostbite_classify(PassGraph& graph, const GBuffer& gbuffer, const Tracers::Images& images,
                                  const Image& color, const FrostbiteRayParameters& parameters,
                                  RayProbe* probe = nullptr);

/// Lists the rays of every traced pixel, and prepares the arguments.
FrostbiteWork frostbite_allocate(PassGraph& graph, const GBuffer& gbuffer, const FrostbiteTiles& tiles,
                                 const FrostbiteRayParameters& parameters);

/// Both tracers. `images`: of parameters.tracers; `below_horizon`: of FrostbiteHorizonImage.
TracedRays frostbite_trace(PassGraph& graph, const Tracers::Images& images, const FrostbiteWork& work,
                           const Image& below_horizon, const FrostbiteRayParameters& parameters,
                           RayProbe* probe = nullptr);

/// `color`: the lit image that hits show, with its mips for filtered_sampling. `split_sum`: of SplitSumImage;
/// `below_horizon`: of FrostbiteHorizonImage.
FrostbiteResolved frostbite_resolve(PassGraph& graph, const GBuffer& gbuffer, const Image& color,
                                    const Image& split_sum, const Image& below_horizon, const TracedRays& rays,
                                    const FrostbiteResolveParameters& parameters);

/// rgba32f: rgb incident radiance, a confidence. `split_sum`: of SplitSumImage.
Image frostbite_accumulate(PassGraph& graph, const GBuffer& gbuffer, const Image& split_sum,
                           const FrostbiteResolved& resolved, const FrostbiteResolveParameters& parameters);
