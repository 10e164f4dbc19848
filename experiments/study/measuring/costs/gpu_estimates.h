#pragma once
#include "experiments/study/measuring/costs/compiled_shaders.h"
#include "experiments/study/measuring/costs/traced_frame.h"

// Estimated time on a GPU that the machine does not have. The chip's compiler gives the code of each pass; a replay of
// the chip's waves gives how often each block runs; published rates give the time. Assumptions:
// experiments/gpu_costs/chips/README.md.

/// Rows of estimates.csv of this shot: the frame's stages and their `total`. A chip that cannot be compiled for, a
/// shader that its compiler refuses, and a chip without published rates give rows without numbers.
std::vector<EstimateRow> estimate_rows(const TracedFrame& frame, const std::string& shot, const PointConfig& point,
                                       const GpuCompilers& compilers, const ChipCompilation& how);

/// Rows of estimates.csv for a frame that could not be traced: refusals, with `why`.
std::vector<EstimateRow> refused_estimates(const std::string& why, const std::string& shot, const PointConfig& point,
                                           const GpuCompilers& compilers);

/// The first refusal by an installed compiler, or what it did not finish; "" if there is none.
std::string refusal_in(const std::vector<EstimateRow>& rows);
