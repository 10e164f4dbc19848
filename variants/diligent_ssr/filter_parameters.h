#pragma once
#include "core/parameters.h"

/// Parameters of spatial reconstruction, temporal accumulation and bilateral cleanup, under the original's names; see
/// tracing_parameters.h.
struct DiligentFilterParameters {
    ParameterSet& params;

    // clang-format off
    Switch spatial_reconstruction{params, "spatial_reconstruction", true,
        {"", "reuses the rays of eight neighbours; otherwise a pixel has its own ray, and a variance of 1 as without "
         "history", "ssrlab, to measure the stage"}};
    Switch temporal_accumulation{params, "temporal_accumulation", true,
        {"", "blends with history", "ssrlab, to measure the stage"}};
    Switch bilateral_cleanup{params, "bilateral_cleanup", true,
        {"", "filters what is still noisy", "ssrlab, to measure the stage"}};
    Param<float> spatial_reconstruction_radius{params, "spatial_reconstruction_radius", 4.0f, {0.0f, 32.0f},
        {"pixels", "radius of the disk of neighbours, from a roughness of 0.2 on; smaller below. From 2 on a larger one is further from the "
         "truth, and not less noisy, as there are always eight neighbours (README.md)",
         "DiligentFX, SpatialReconstructionRadius; its user interface offers 2 to 8"}};
    Param<float> temporal_radiance_stability_factor{params, "temporal_radiance_stability_factor", 1.0f, {0.0f, 1.0f},
        {"", "weight of history in the colour. The default of 1 never averages: history is only moved by the clamp to its "
         "neighbourhood", "DiligentFX, TemporalRadianceStabilityFactor"}};
    Param<float> temporal_variance_stability_factor{params, "temporal_variance_stability_factor", 0.9f, {0.0f, 1.0f},
        {"", "weight of history in the variance", "DiligentFX, TemporalVarianceStabilityFactor"}};
    Param<float> bilateral_cleanup_spatial_sigma_factor{params, "bilateral_cleanup_spatial_sigma_factor", 0.9f, {0.0f, 4.0f},
        {"pixels", "standard deviation of the cleanup's kernel, which reaches twice as far, at most two pixels",
         "DiligentFX, BilateralCleanupSpatialSigmaFactor"}};
    Param<float> alpha_interpolation{params, "alpha_interpolation", 1.0f, {0.0f, 1.0f},
        {"", "multiplies the confidence. The original fades reflections in with it while its pipelines compile",
         "DiligentFX, AlphaInterpolation"}};

    // In the document, but not in the original's code.
    Choice cleanup{params, "cleanup", "bilateral", {"bilateral", "guided"},
        {"", "the filter of what is still noisy. guided: lines in the distance from the camera plane that fit windows of the same size, "
         "whose cost need not grow with the window (He et al. 2010)", "DiligentFX: bilateral; its document would try guided"}};
    Param<float> guided_epsilon{params, "guided_epsilon", 0.01f, {1e-6f, 1.0f},
        {"of the distance", "depth over a window, as a deviation, below which the guided filter averages rather than follows", "ssrlab"}};
    Choice reconstruction_space{params, "reconstruction_space", "screen", {"screen", "world"},
        {"", "where the disk of neighbours lies. world: on the plane of the surface, as wide as its radius of pixels is there, so that "
         "grazing views take neighbours that are near each other", "DiligentFX: screen; its document would try world"}};
    Switch variable_samples{params, "variable_samples", false,
        {"", "takes as many of the eight neighbours, at least one, as their disk is wide by the roughness", "DiligentFX's document; the "
         "proportion is ssrlab's"}};
    Switch sigma_from_variance{params, "sigma_from_variance", false,
        {"", "the standard deviation of the cleanup's kernel grows with that of the radiance d, as d / (d + 0.1), in place of a "
         "threshold. Below 1, it can only narrow the kernel: one that widens takes a bilateral_cleanup_spatial_sigma_factor above 1",
         "DiligentFX's document, without a formula"}};

    // What differs between 2024 and 2026.
    Choice spatial_kernel{params, "spatial_kernel", "gaussian", {"gaussian", "double_gaussian"},
        {"", "how a neighbour's ray counts by its distance. double_gaussian: a Gaussian of the Gaussian, by which far "
         "neighbours count more than near ones", "DiligentFX; double_gaussian until June 2026"}};
    Switch distribution_floor{params, "distribution_floor", true,
        {"", "keeps the denominator of the GGX distribution above 1e-9, which flattens the peak of roughness below 0.065",
         "DiligentFX; not in 2024"}};
    Switch short_ray_guard{params, "short_ray_guard", true,
        {"", "rays shorter than 1e-6 m, those of pixels that trace none among them, count as little as can be. Without it "
         "their direction is 0 times infinity", "DiligentFX; not in 2024"}};
    Choice history_search{params, "history_search", "camera_depth", {"camera_depth", "device_depth"},
        {"", "how history that moved behind something is looked for nearby. camera_depth: by distances from the camera "
         "plane, among single texels; device_depth: by filtered values of the depth buffer", "DiligentFX; device_depth in 2024"}};

    Switch start_from_black{params, "start_from_black", false,
        {"", "the first frame blends with black histories, as in an application whose previous depth is then the frame's "
         "own; with the default weight of history averaging never removes that black. Otherwise the first frame "
         "has no history, as where the previous depth is cleared", "DiligentFX leaves it to the application"}};

    // Corrections.
    Switch rotate_kernel{params, "rotate_kernel", true,
        {"", "turns the disk of neighbours from frame to frame. The original's code does, but its applications seldom set "
         "the frame index that it reads, so that the pattern stands still", "DiligentFX"}};
    Switch own_ray{params, "own_ray", false,
        {"", "also uses a pixel's own ray, which the original's eight neighbours exclude", "ssrlab"}};
    Switch scale_radius{params, "scale_radius", false,
        {"", "with half_resolution, a radius of as many rays; in the original of as many pixels, which is half as many rays",
         "ssrlab; an open issue of DiligentFX"}};
    Switch nearest_half_rays{params, "nearest_half_rays", false,
        {"", "with half_resolution, the ray of the 2x2 pixels that a point lies in; the original rounds up, so that odd "
         "rows and columns take the next one and mirror images shift", "ssrlab"}};
    Switch axial_hit_depth{params, "axial_hit_depth", false,
        {"", "takes the mirrored point's depth along the camera's axis. The original takes its distance from the camera for "
         "it, which is too far by up to half at the corners of the screen", "ssrlab"}};
    Switch linear_hit_depth{params, "linear_hit_depth", false,
        {"", "keeps that depth in metres and 32 bits. The original keeps a value of the depth buffer in 16 bits: 2 m steps at "
         "20 m", "ssrlab"}};
    Switch centered_search{params, "centered_search", false,
        {"", "looks for lost history at the nearest texels first. The original starts at the upper left and takes the first "
         "that is good enough; with device_depth the best, of several the first", "ssrlab"}};
    Switch guard_previous_clip{params, "guard_previous_clip", false,
        {"", "points that were behind the camera have no history. The original divides by their negative w", "ssrlab"}};
    Switch finite_weights{params, "finite_weights", false,
        {"", "rays whose weight or direction is not a number count nothing; what the original makes of them is up to the "
         "driver", "ssrlab"}};
    Switch clear_targets{params, "clear_targets", false,
        {"", "clears the pixels outside of the mask, where the original's filters read stale data", "ssrlab"}};
    Switch float_histories{params, "float_histories", false,
        {"", "keeps reconstructed colours, variances and histories in 32 bits in place of 16, whose storing darkens history "
         "on devices that truncate", "ssrlab; DiligentFX stores RGBA16F and R16F"}};
    // clang-format on
};
