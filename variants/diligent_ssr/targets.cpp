#include "variants/diligent_ssr/targets.h"

Image diligent_target(PassGraph& graph, const std::string& name, Format format, glm::uvec2 extent, bool is_cleared) {
    const Image target = graph.image_black_at_first(name, format, extent);
    if (is_cleared) graph.clear(target, {});
    return target;
}

void draw_masked(PassGraph::Pass& pass, const Image& mask) {
    // Kept pixels hold a depth of 1, or a stencil value of 255; the triangle lies at depth 0.
    if (mask.format == Format::d16)
        pass.depth({.compare = DepthTest::Compare::less, .is_written = false, .image = mask});
    else
        pass.stencil({.mode = Stencil::Mode::keep_equal, .value = 255, .image = mask});
    pass.run();
}
