#pragma once
#include "experiments/study/measuring/costs/compiled_shaders.h"
#include "experiments/study/measuring/costs/traced_frame.h"

// How long a GPU that is not there would take: what its compiler makes of each pass, as often as waves of the chip's
// width would run each block of it, against the chip's published rates. experiments/gpu_costs/chips/README.md
// says what is assumed.

/// Rows of estimates.csv, of the shot of that name: the stages of the frame, and their `total`. A chip that cannot be
/// asked, a shader that it refuses and a chip without published rates are rows without numbers.
std::vector<EstimateRow> estimate_rows(const TracedFrame& frame, const std::string& shot, const PointConfig& point,
                                       const GpuCompilers& compilers, const ChipCompilation& how);

/// The same of a frame that could not be traced.
std::vector<EstimateRow> refused_estimates(const std::string& why, const std::string& shot, const PointConfig& point,
                                           const GpuCompilers& compilers);

/// What a compiler that is there refused, or did not get to; "" if nothing.
std::string refusal_in(const std::vector<EstimateRow>& rows);
