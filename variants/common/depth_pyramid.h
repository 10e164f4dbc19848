#pragma once
#include "core/gpu/pass_graph.h"

/// Mip 0 is `depth`, each following texel the nearest of 2x2: min, or max for reversed depth. `mips` at least 2, capped
/// by the extent. One dispatch (AMD's Single Pass Downsampler). Odd-sized levels leave their last row or column out.
Image nearest_depth_pyramid(PassGraph& graph, const Image& depth, unsigned mips);
