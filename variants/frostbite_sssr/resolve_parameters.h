#pragma once
#include "core/parameters.h"

/// Parameters of colour, resolve and temporal filter; see ray_parameters.h.
struct FrostbiteResolveParameters {
    ParameterSet& params;

    // clang-format off
    Switch previous_frame{params, "previous_frame", true,
        {"", "hits take their colour from the previous frame's lit image, where they were then", "slides"}};
    Choice hidden_hits{params, "hidden_hits", "show", {"show", "miss", "drop"},
        {"", "with previous_frame, hits that the previous frame did not show, since something else was in front of them or "
         "they faced away. show: the colour of what was there; miss: they count as misses; drop: not at all, so that "
         "others, if any, stand in for them", "ssrlab; the slides do not say"}};
    Switch filtered_sampling{params, "filtered_sampling", true,
        {"", "hits take their colour from a mip level as wide as the cone that holds half of the truncated lobe, however many rays "
         "share it; Colbert and Krivanek's is as wide as one ray's share, of the solid angle 1 / (rays times density)",
         "slides; Colbert and Krivanek 2007, 'GPU-Based Importance Sampling', GPU Gems 3, chapter 20"}};
    Param<float> cone_scale{params, "cone_scale", 1.0f, {0.0f, 8.0f},
        {"", "tangent of the cone's half angle over that which holds half of the truncated lobe seen along the normal: "
         "2 t / (1 - t^2), t = alpha sqrt((1 - importance_bias) / (1 + importance_bias))",
         "ssrlab; the slides' fit is not published"}};
    Choice grazing_cone{params, "grazing_cone", "published", {"published", "lobe", "off"},
        {"", "what narrows the cone towards grazing views. published: times mix(saturate(2 cos), 1, sqrt(roughness)); lobe: "
         "as the lobe does, times sqrt((1 + 2 cos^2) / 3); off: nothing", "slides: published; lobe is ours"}};

    // Reuse of neighbours' rays.
    Choice taps{params, "taps", "4", {"1", "4", "16"},
        {"", "traced pixels whose rays a pixel resolves, all of each; 1: its own, whatever the pattern. Those that the "
         "border or rounding brings together count once", "slides: 4 and 1; Stachowiak 2018: 16"}};
    Choice pattern{params, "pattern", "rotated", {"rotated", "quad_shared", "interleaved"},
        {"", "which neighbours. rotated: points of a disk, turned per pixel and frame; quad_shared: 2x2 pixels fetch the "
         "same rays together; interleaved: four pixels of a 4x4 block, two pixels apart, do, and the blocks move every "
         "frame. Colours are read by each pixel, as wide as its own lobe", "slides describe the sharing, which is of "
         "colours, too; offsets and phases are ours"}};
    Choice neighbor_ray{params, "neighbor_ray", "hit_point", {"hit_point", "direction"},
        {"", "how a neighbour's ray is seen from the pixel that reuses it: aimed at the point that it hit, or in its own "
         "direction", "slides: hit_point"}};
    Switch reuse_jacobian{params, "reuse_jacobian", false,
        {"", "with hit_point, converts the neighbour's density to the pixel's solid angle", "ssrlab; the slides ignore it"}};
    Choice estimator{params, "estimator", "a", {"a", "b", "c"},
        {"", "a: sum L f / p over sum f / p, times the integral of f; b: sum L f / p over sum q / p; c: as a with q in "
         "place of f. f is the pixel's BRDF times cosine, q its own density of directions, p the ray's. The share of the "
         "lobe below the horizon counts in b's second sum: as drawn, or with max_regenerations as it is known to be",
         "a: slides; b: Stachowiak's kajiya; c: Blender's EEVEE"}};
    Choice misses{params, "misses", "weight", {"weight", "fallback"},
        {"", "what a ray without a hit contributes. weight: only less confidence; fallback: the environment in its "
         "direction", "slides: weight; fallback: Blender's EEVEE"}};

    // Temporal filter.
    Switch temporal_filter{params, "temporal_filter", true, {"", "blends with history", "slides"}};
    Param<float> history_weight{params, "history_weight", 0.9f, {0.0f, 1.0f}, {"", "share of history", "ssrlab"}};
    Choice reflection_depth{params, "reflection_depth", "average", {"average", "min", "max"},
        {"", "length that the resolved rays are given for reprojection; min and max are of rays that the pixel is at least "
         "a thousandth as likely to draw as their own", "slides: average; min: EEVEE; max and the limit: Wicked Engine"}};
    Switch reject_without_hits{params, "reject_without_hits", false,
        {"", "a pixel of which no ray hit anything forgets its history; otherwise it is blended with it as any other, "
         "and fades. Not with misses = fallback, which always see something", "ssrlab"}};
    Switch neighborhood_clamp{params, "neighborhood_clamp", true,
        {"", "clamps history to the box of the 3x3 neighbours' colours", "slides; Karis 2014"}};
    Param<float> clamp_scale{params, "clamp_scale", 2.0f, {0.0f, 100.0f},
        {"", "by which that box is expanded about its centre", "slides: expanded; the factor is ours"}};
    Switch float_histories{params, "float_histories", true,
        {"", "keeps history in 32 bits; in 16 some devices truncate it, so that it darkens", "ssrlab; the slides do not say"}};
    Switch reflectance_after_filter{params, "reflectance_after_filter", true,
        {"", "multiplies by the integral of the BRDF after the temporal filter; otherwise before it", "slides"}};
    // clang-format on
};
