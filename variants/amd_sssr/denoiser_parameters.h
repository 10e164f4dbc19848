#pragma once
#include "core/parameters.h"

/// Parameters of the three denoiser passes. "Denoiser 1.3" is the effect in FidelityFX SDK 1.1.4 (reflections); its
/// constants are parameters here. Switches under "corrections" fix one defect each.
struct AmdDenoiserParameters {
    ParameterSet& params;

    // clang-format off
    Switch denoise{params, "denoise", true,
        {"", "runs the denoiser; otherwise the rays' radiance is the result", "ssrlab, for the study of the rays alone"}};
    Switch reprojection{params, "reprojection", true,
        {"", "looks history up; otherwise no pixel has any", "ssrlab, to measure the stage"}};
    Switch prefilter{params, "prefilter", true,
        {"", "filters over neighbours", "ssrlab, to measure the stage"}};
    Switch temporal_resolve{params, "temporal_resolve", true,
        {"", "accumulates; otherwise the prefilter's output is the result", "ssrlab, to measure the stage"}};
    Param<float> temporal_stability_factor{params, "temporal_stability_factor", 0.7f, {0.0f, 1.0f},
        {"", "scales the box of neighbouring colours that history is clipped to", "SSSR 1.5, temporalStabilityFactor"}};
    Param<float> max_samples{params, "max_samples", 32.0f, {1.0f, 1024.0f},
        {"frames", "longest history of a rough pixel; where it is lower, min_history_samples wins",
         "Denoiser 1.3, literal in the reprojection"}};
    Param<float> min_history_samples{params, "min_history_samples", 8.0f, {1.0f, 1024.0f},
        {"frames", "longest history of a mirror; no pixel's is shorter, even where max_samples is lower",
         "Denoiser 1.3, get_max_samples"}};
    Param<float> samples_per_alpha{params, "samples_per_alpha", 100.0f, {0.0f, 1e4f},
        {"1 / alpha", "k of 1 - exp(-k alpha), which goes from the mirror's history to the longest",
         "Denoiser 1.3, SAMPLES_FOR_ROUGHNESS"}};
    Param<float> gaussian_k{params, "gaussian_k", 3.0f, {0.0f, 100.0f},
        {"", "k of the weight exp(-k i^2 / 25) of a neighbour i pixels away, in the 9x9 moments", "Denoiser 1.3, GAUSSIAN_K"}};
    Param<float> radiance_weight_bias{params, "radiance_weight_bias", 0.6f, {0.0f, 100.0f},
        {"W^-1 sr m^2", "how fast the prefilter's weight falls with the distance to the tile's average colour",
         "Denoiser 1.3, RADIANCE_WEIGHT_BIAS"}};
    Param<float> radiance_weight_variance_k{params, "radiance_weight_variance_k", 0.1f, {0.0f, 100.0f},
        {"", "what variance adds to it", "Denoiser 1.3, RADIANCE_WEIGHT_VARIANCE_K"}};
    Param<float> avg_radiance_luminance_weight{params, "avg_radiance_luminance_weight", 0.3f, {0.0f, 100.0f},
        {"W^-1 sr m^2", "how fast a pixel's weight in the tile's average falls with its luminance",
         "Denoiser 1.3, AVG_RADIANCE_LUMINANCE_WEIGHT"}};
    Param<float> average_reprojected_share{params, "average_reprojected_share", 0.3f, {0.0f, 1.0f},
        {"", "share of the reprojected radiance in the tile's average", "Denoiser 1.3, literal in the reprojection"}};
    Param<float> prefilter_variance_weight{params, "prefilter_variance_weight", 4.4f, {0.0f, 100.0f},
        {"", "how fast the prefilter grows with variance", "Denoiser 1.3, PREFILTER_VARIANCE_WEIGHT"}};
    Param<float> prefilter_variance_bias{params, "prefilter_variance_bias", 0.1f, {0.0f, 1.0f},
        {"", "least strength of the prefilter", "Denoiser 1.3, PREFILTER_VARIANCE_BIAS"}};
    Param<float> prefilter_normal_sigma{params, "prefilter_normal_sigma", 512.0f, {0.0f, 1e4f},
        {"", "exponent of the cosine between a neighbour's normal and the pixel's", "Denoiser 1.3, PREFILTER_NORMAL_SIGMA"}};
    Param<float> prefilter_depth_sigma{params, "prefilter_depth_sigma", 4.0f, {0.0f, 1e6f},
        {"m^-2", "k of the weight exp(-k z |z - z_neighbour|); depends on the unit of length",
         "Denoiser 1.3, PREFILTER_DEPTH_SIGMA"}};
    Param<float> surface_discard_variance_weight{params, "surface_discard_variance_weight", 1.5f, {0.0f, 100.0f},
        {"", "history that differs from the neighbourhood's mean by more than this many variances is not reprojected along "
         "the surface's motion", "Denoiser 1.3, REPROJECT_SURFACE_DISCARD_VARIANCE_WEIGHT"}};
    Param<float> disocclusion_normal_weight{params, "disocclusion_normal_weight", 1.4f, {0.0f, 100.0f},
        {"", "weight of a changed normal in the disocclusion factor", "Denoiser 1.3, DISOCCLUSION_NORMAL_WEIGHT"}};
    Param<float> disocclusion_depth_weight{params, "disocclusion_depth_weight", 1.0f, {0.0f, 100.0f},
        {"", "weight of a relative change of depth in it", "Denoiser 1.3, DISOCCLUSION_DEPTH_WEIGHT"}};
    Param<float> disocclusion_threshold{params, "disocclusion_threshold", 0.9f, {0.0f, 1.0f},
        {"", "factor below which history is given up; half of it for single texels", "Denoiser 1.3, DISOCCLUSION_THRESHOLD"}};
    Param<float> normal_similarity_threshold{params, "normal_similarity_threshold", 0.9999f, {0.0f, 1.0f},
        {"cosine", "agreement of normals from which history is looked up where the reflected point was, not the surface",
         "Denoiser 1.3, REPROJECTION_NORMAL_SIMILARITY_THRESHOLD"}};
    Param<float> clip_scale{params, "clip_scale", 1.4f, {0.0f, 100.0f},
        {"standard deviations", "half extent of the box that history is clipped to, before temporal_stability_factor",
         "Denoiser 1.3, literal in the temporal resolve"}};
    Param<float> average_pull{params, "average_pull", 0.2f, {0.0f, 1.0f},
        {"", "share of the tile's average in the centre of that box", "Denoiser 1.3, literal in the temporal resolve"}};
    Param<float> dark_exit_radiance{params, "dark_exit_radiance", 1e-4f, {0.0f, 1.0f},
        {"W sr^-1 m^-2", "the temporal resolve sets darker pixels (sum of rgb) to 0", "Denoiser 1.3, RADIANCE_THRESHOLD"}};
    Switch stale_average{params, "stale_average", false,
        {"", "prefilter and resolve read the tile averages of the last frame, as the host code of Denoiser 1.3 binds them "
         "by mistake: the first frame comes out black", "Denoiser 1.3, host code"}};
    Choice denoiser_form{params, "denoiser_form", "by_device", {"by_device", "fast", "faithful", "float16"},
        {"", "faithful: shaders laid out as the original's, a thread per pixel. fast: the same output within half-float "
         "rounding, a thread per column of a tile, in classification per tile: a fifth of the denoiser's time on "
         "lavapipe and 0.6 of classification's; on an NVIDIA H200 1.2 to 1.4 times the denoiser's. "
         "float16: faithful, with the moments of 9x9 neighbours summed in half floats. by_device: fast on "
         "a CPU, on a GPU faithful with barrier_before_average",
         "ssrlab"}};

    // Corrections.
    Switch barrier_before_average{params, "barrier_before_average", false,
        {"", "waits until all of a tile's moments are computed before shared memory is reused for its average; without it "
         "results vary from run to run where a subgroup is smaller than the tile. The fast form shares no moments and needs none", "ssrlab"}};
    Switch current_sample_count{params, "current_sample_count", false,
        {"", "the temporal resolve weights history by this frame's reprojected sample count; the original binds the last "
         "frame's count at the same pixel", "ssrlab; Denoiser 1.3 and 1.2, host code"}};
    Switch no_dark_exit{params, "no_dark_exit", false,
        {"", "dark pixels are accumulated like all others; the original sets them to 0 at once", "ssrlab; as in Denoiser 1.2"}};
    Switch running_variance{params, "running_variance", false,
        {"", "variance is a running mean over the history; the original mixes the other way round, so that long histories "
         "keep only the newest change", "ssrlab"}};
    Switch round_up_tiles{params, "round_up_tiles", false,
        {"", "looks up tile averages by the true number of tiles; the original adds 8 pixels instead of rounding up to a "
         "multiple of 8", "ssrlab"}};
    Switch relative_depth_weight{params, "relative_depth_weight", false,
        {"", "the prefilter's depth weight is exp(-k |z - z_neighbour| / z), the same in any unit and at any distance",
         "ssrlab"}};
    Switch reproject_history_depth{params, "reproject_history_depth", false,
        {"", "compares the depth of history with the depth that the surface had in the last frame's camera; the original "
         "compares with this frame's, and loses history when the camera moves along its axis", "ssrlab"}};
    Switch guard_previous_clip{params, "guard_previous_clip", false,
        {"", "points that were behind the camera have no history. The original divides by their negative w, and looks the "
         "reflected point up on the other side of the screen", "ssrlab"}};
    Switch finite_neighborhood{params, "finite_neighborhood", false,
        {"", "clamps radiance to the largest half float before it is shared, and excludes non-finite neighbours",
         "ssrlab; the overflow is FidelityFX SDK issue 186"}};
    Switch fresh_neighborhood{params, "fresh_neighborhood", false,
        {"", "filters next to tiles without a glossy pixel read this frame's colours there, no variance and no average; the "
         "original reads stale data of earlier frames", "ssrlab; FidelityFX SSSR issue 4"}};
    Switch float_histories{params, "float_histories", false,
        {"", "keeps radiance, variance, counts and averages in 32 bits; truncated half floats drift darker as they "
         "accumulate. The faithful form still shares halves between the threads of a tile",
         "ssrlab; the original's formats are R16G16B16A16_FLOAT, R16_FLOAT and R11G11B10_FLOAT"}};
    // clang-format on
};
