#pragma once
#include "core/gpu/passes/pass_list.h"

/// A pyramid of depths as DiligentFX makes it, for machines without compute shaders: one draw for each level, as many
/// as the chosen marches ask for. C++, since no list of passes says how many they are, nor which draw fills which
/// image: mip 0 is `depth`, each following texel the nearest (or farthest) of the 2x2 below, or of three where the
/// level below is odd. `has_mip_views`: a level is drawn while another of the same image is read, as WebGL 2 cannot;
/// otherwise each finished level is copied to a second image first. Images `depth_pyramid`, `farthest_depth_pyramid`.
Image drawn_pyramid(PassList& pass_list, const Image& depth, unsigned max_mips, bool keeps_farthest,
                    bool has_mip_views);

inline const std::string drawn_pyramid_stage = "diligent_ssr/depth_hierarchy";
inline const std::vector<std::string> drawn_pyramid_shaders = {
    "diligent_ssr/copy_level.frag", "diligent_ssr/copy_surfaces.frag", "diligent_ssr/depth_hierarchy.frag"};
