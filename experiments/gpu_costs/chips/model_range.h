#pragma once
#include <string>

// The uncertainty of the chip's model. Intervals of estimated times include sampling alone.

/// Range of measured time / estimated time of stages: 5th to 95th percentile.
struct ModelRange {
    double low, high;
};

/// Times on an NVIDIA H200 / estimates for navi21 (0.22 to 11.5) and gfx1100 (0.38 to 12.8): stages of 48 points in two
/// scenes at 1920x1080, without draws and clears. Estimates: experiments/studies/configs/gpu_quality.json at commit
/// 2a846a4662; times: experiments/studies/configs/gpu_measured.json at commit 23f2cf040e. The GPU is of another vendor,
/// so the range includes the difference of the chips. `experiments/study/measuring/costs/cost_agreement.py
/// --model-range` repeats the measurement.
inline constexpr ModelRange model_range{0.22, 12.8};

/// Estimates of two points within this factor do not say which point takes longer. With larger factors, all 1263 pairs
/// whose times on the H200 differed by as much were in order (studies/questions/gpu_times.md).
inline constexpr double model_decides_from = 1.5;

/// "measured times of stages were 0.22 to 12.8 times such estimates (NVIDIA H200, gpu_measured)"
std::string model_range_text();
