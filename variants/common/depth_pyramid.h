#pragma once
#include "core/gpu/passes/pass_list.h"

/// Image `depth_pyramid`: mip 0 is `depth`, each following texel the nearest of 2x2: min, or max for reversed depth.
/// `mips` at least 2, capped by the extent. One dispatch (AMD's Single Pass Downsampler). Odd-sized levels leave their
/// last row or column out. `keeps_farthest`: image `farthest_depth_pyramid`, the same with the farthest surface of 2x2.
/// Background is none, and stands as the near plane, in mip 0 too.
Image depth_pyramid(PassList& pass_list, const Image& depth, unsigned mips, bool keeps_farthest);
