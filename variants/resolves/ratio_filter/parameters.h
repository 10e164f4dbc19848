#pragma once
#include "core/parameters.h"

/// Parameters of the ratio filter. "EEVEE" is source/blender/draw/engines/eevee/shaders/eevee_ray_denoise.bsl.hh of
/// Blender at commit 14c380e9, "classic" its predecessors eevee_ray_denoise_{spatial,temporal,bilateral}_comp.glsl at
/// 3b3a5731 (GPL: what follows is written from their formulas). Both keep colours in 11-bit floats, variances in halves
/// and noise in textures; here are 32-bit floats and hashed random numbers. Both have a light probe where a ray meets
/// nothing; here colours carry the share of them that is known, and without any ray of weight nothing is known, where
/// the originals show black. A ray starts where it was traced and each pixel's own lobe weighs it; with one ray for
/// several pixels EEVEE takes both from a place up to a pixel away. Switches under "corrections" fix one defect each.
struct RatioFilterParameters {
    ParameterSet& params;

    // clang-format off
    // Neighbours' rays.
    Switch spatial_reuse{params, "spatial_reuse", true,
        {"", "weighs rays of neighbours; otherwise each pixel has those of its traced pixel", "ssrlab, to measure the stage"}};
    Choice kernel{params, "kernel", "disk", {"disk", "box"},
        {"", "where neighbours are. disk: around the pixel, which is the first of them, narrower across the direction in which its normal "
         "leans; box: anywhere in a square, the pixel itself or not", "EEVEE: disk; classic: box"}};
    Param<unsigned> max_taps{params, "max_taps", 16, {1, 64}, {"traced pixels", "whose rays a rough pixel has", "EEVEE, classic"}};
    Param<float> full_roughness{params, "full_roughness", 0.125f, {1e-3f, 1.0f},
        {"perceptual", "from which there are that many, and filters are as wide as they get; mirrors have one", "EEVEE, classic"}};
    Param<float> disk_radius{params, "disk_radius", 8.0f, {0.0f, 64.0f},
        {"traced pixels", "times the root of the share of full_roughness, but at most 7/8 of it", "EEVEE"}};
    Param<float> box_width{params, "box_width", 12.0f, {0.0f, 64.0f},
        {"traced pixels", "times the same root", "classic"}};
    Choice neighbor_ray{params, "neighbor_ray", "plane", {"plane", "direction", "hit_point"},
        {"", "how a neighbour's ray is seen. plane: from the pixel towards what it hit, as if the neighbour lay on the pixel's plane and, "
         "on rough surfaces, nearer; direction: as it is; hit_point: from the pixel towards the point that it hit",
         "EEVEE: plane; classic: direction; hit_point is ours"}};
    Choice averages{params, "averages", "logarithmic", {"logarithmic", "linear"},
        {"", "of colours. logarithmic: means of log2(1 + c), and variance over mean of that, which darkens what scatters; linear: of "
         "colours; bright ones count less in the bilateral filter alone", "EEVEE: logarithmic; classic: linear"}};
    Switch stochastic_upsampling{params, "stochastic_upsampling", true,
        {"", "with half_resolution, pixels between traced ones choose one by chance, as near ones more often; otherwise each 2x2 pixels "
         "share theirs", "EEVEE; classic: off"}};

    // History.
    Switch temporal_accumulation{params, "temporal_accumulation", true,
        {"", "blends with history", "ssrlab, to measure the stage"}};
    Param<float> history_weight{params, "history_weight", 0.97f, {0.0f, 1.0f}, {"", "share of history", "EEVEE, classic"}};
    Param<float> calm_history{params, "calm_history", 0.75f, {0.0f, 1.0f},
        {"", "factor of that where rays do not scatter", "EEVEE, classic"}};
    Param<float> full_history_variance{params, "full_history_variance", 0.05f, {1e-6f, 1e6f},
        {"", "variance, of the kind that `averages` has, from which the factor is 1", "EEVEE, classic"}};
    Param<float> clamp_deviations{params, "clamp_deviations", 1.0f, {0.0f, 1e6f},
        {"standard deviations", "that history may lie from the mean of 3x3 pixels", "EEVEE, classic"}};
    Choice variance_mean{params, "variance_mean", "quadratic", {"quadratic", "linear"},
        {"", "how the variance is blended with that of the frame before", "EEVEE: quadratic; classic: linear"}};
    Param<float> variance_history_weight{params, "variance_history_weight", 0.85f, {0.0f, 1.0f},
        {"", "share of the latter", "EEVEE; classic: 0.9"}};

    // Cleanup.
    Switch bilateral_filter{params, "bilateral_filter", true,
        {"", "averages neighbours on the pixel's plane where the variance is high; history does not hold that",
         "ssrlab, to measure the stage"}};
    Param<float> bilateral_variance{params, "bilateral_variance", 0.1f, {0.0f, 1e6f},
        {"", "below which it does not", "EEVEE; classic: 0.05"}};
    Choice bilateral_size{params, "bilateral_size", "variance", {"variance", "roughness"},
        {"", "what widens it. variance: up to 15 neighbours, in a square that is wider on rough surfaces, too; roughness: up to 10, and half as "
         "many again above a variance of 0.5", "EEVEE: variance; classic: roughness"}};
    Param<float> bilateral_width{params, "bilateral_width", 9.0f, {0.0f, 64.0f}, {"pixels", "of its square", "EEVEE, classic"}};

    // Corrections.
    Choice numerator{params, "numerator", "density", {"density", "brdf"},
        {"", "what weighs a ray, over its density. density: that of its direction in the pixel's lobe of visible normals, whose mean "
         "differs from what the BRDF reflects; brdf: BRDF times cosine, without Fresnel's term",
         "EEVEE: density; brdf: Stachowiak & Uludag 2015"}};
    Switch local_horizon{params, "local_horizon", false,
        {"", "neighbours' rays that go below the pixel's own horizon do not count, and it is known that those into its surface bring no light. "
         "The original counts what they see", "ssrlab"}};
    Switch reuse_jacobian{params, "reuse_jacobian", false,
        {"", "with hit_point, converts the neighbour's density to the pixel's solid angle", "ssrlab"}};
    Switch sharp_mirrors{params, "sharp_mirrors", false,
        {"", "with half_resolution, pixels of roughness 0 have the rays of their own traced pixel alone. In the original five rays are the least",
         "ssrlab"}};
    Choice reflection_depth{params, "reflection_depth", "min", {"min", "mean"},
        {"", "of the lengths of rays, where history is looked for. One short ray draws the shortest away from the others",
         "EEVEE: min; mean is ours"}};
    Switch exact_mirror_image{params, "exact_mirror_image", false,
        {"", "history is looked for where a mirror shows something as far behind it as rays are long. The original puts it that far along "
         "the camera's axis, which is farther away from it off the axis", "ssrlab"}};
    Switch whole_history{params, "whole_history", false,
        {"", "of history of which a part lies beyond the border the rest is compared. In the original the missing part is black",
         "ssrlab"}};
    Switch test_likeness{params, "test_likeness", false,
        {"", "refuses history that is less than a thousandth as likely as what is equal. The original makes this test after it has "
         "normalised weights, and it then refuses nothing but what underflows", "ssrlab"}};
    Switch follow_motion{params, "follow_motion", false,
        {"", "looks for history of surfaces where motion vectors say; the original knows the camera's motion alone", "ssrlab"}};
    Switch scale_free{params, "scale_free", false,
        {"", "the bilateral filter's neighbours lie on the plane up to a share of the camera's distance, 1 % for half the weight. In the original "
         "it is 1 cm", "ssrlab"}};
    // clang-format on
};
