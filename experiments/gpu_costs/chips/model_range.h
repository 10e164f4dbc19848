#pragma once
#include <string>

// What the interval of an estimated time leaves open: whether the model of the chip holds. Intervals are of sampling
// alone.

/// By so many times a stage's measured time was its estimate: from the 5th to the 95th percentile.
struct ModelRange {
    double low, high;
};

/// Of times on an NVIDIA H200 over estimates for navi21 (0.22 to 11.5) and gfx1100 (0.38 to 12.8): the stages of 48
/// points in two scenes at 1920x1080, without what draws and without clears. Estimates of
/// experiments/studies/configs/gpu_quality.json by commit 2a846a4662, times of
/// experiments/studies/configs/gpu_measured.json by commit 23f2cf040e. Another vendor's GPU: the range holds what
/// differs between the chips, too. experiments/study/measuring/costs/cost_agreement.py --model-range makes it anew.
inline constexpr ModelRange model_range{0.22, 12.8};

/// Estimates of two points that differ by less than this factor do not say which takes longer. Where they differ by
/// more, all 1263 pairs of points that differed by as much in time on the H200 were in order (experiments/README.md).
inline constexpr double model_decides_from = 1.5;

/// "measured times of stages were 0.22 to 12.8 times such estimates (NVIDIA H200, gpu_measured)"
std::string model_range_text();
