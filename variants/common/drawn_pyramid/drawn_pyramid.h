#pragma once
#include "core/gpu/passes/pass_list.h"

/// A pyramid of depths as DiligentFX makes it, for machines without compute shaders: one draw per level, as many as the
/// chosen tracers need. (A declared list of passes cannot express that number.) Mip 0 is `depth`; each texel of a
/// further mip is the nearest (or farthest) of the 2x2 below, or of three where the level below is odd.
/// `has_mip_views`: draws a level while reading another one of the same image, which WebGL 2 cannot; otherwise each
/// finished level is first copied to a second image. The image is `depth_pyramid` or `farthest_depth_pyramid`.
Image drawn_pyramid(PassList& pass_list, const Image& depth, unsigned max_mips, bool keeps_farthest,
                    bool has_mip_views);

inline const std::string drawn_pyramid_stage = "diligent_ssr/depth_hierarchy";
inline const std::vector<std::string> drawn_pyramid_shaders = {
    "diligent_ssr/copy_level.frag", "diligent_ssr/copy_surfaces.frag", "diligent_ssr/depth_hierarchy.frag"};
