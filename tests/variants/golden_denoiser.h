#pragma once
#include "tests/variants/amd_denoiser_bench.h"
#include "tests/variants/golden_vectors.h"

/// What one frame of a golden denoiser sequence holds: the inputs and what each of the original's passes wrote.
struct GoldenDenoiserFrame {
    DenoiserInputs inputs;
    HostImage reprojected, reprojected_variance, sample_count, average;
    HostImage prefiltered, prefiltered_variance;
    HostImage resolved, resolved_variance;

    /// Pixels that the passes write: in listed tiles, alpha below the threshold.
    bool is_compared(unsigned x, unsigned y, unsigned border) const;
};

/// The frames of a set, without noise.exr.
std::vector<GoldenDenoiserFrame> read_denoiser_frames(const std::string& set);

/// Golden sets that hold a denoiser sequence.
std::vector<std::string> golden_denoiser_sets();
