#pragma once
#include "core/gpu/passes/pass_list.h"

/// Image `depth_pyramid`: mip 0 is `depth`; each texel of a further mip is the nearest of 2x2 (min, or max for reversed
/// depth). `mips`: at least 2, capped by the extent. Takes one dispatch (AMD's Single Pass Downsampler). Levels of odd
/// size leave out their last row or column. With `keeps_farthest` the image is `farthest_depth_pyramid`, with the
/// farthest surface of 2x2; background counts as no surface and is the near plane, also in mip 0.
Image depth_pyramid(PassList& pass_list, const Image& depth, unsigned mips, bool keeps_farthest);
