#pragma once
#include "variants/diligent_ssr/passes.h"

/// A colour target of masked passes: cleared in each frame, or only when it is new, so that the pixels which the mask
/// leaves out keep what older frames wrote.
Image diligent_target(PassGraph& graph, const std::string& name, Format format, glm::uvec2 extent, bool is_cleared);

/// Draws the pixels that the shader does not discard into `mask`, which has been cleared to 0; for a mask by depth the
/// shader writes gl_FragDepth = 1.
void draw_mask(PassGraph::Pass& pass, const Image& mask);

/// Draws only the pixels that `mask` (DiligentMask::full or ::traced) keeps.
void draw_masked(PassGraph::Pass& pass, const Image& mask);
