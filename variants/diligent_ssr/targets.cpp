#include "variants/diligent_ssr/targets.h"

namespace {

constexpr unsigned kept_stencil = 255;

}  // namespace

Image diligent_target(PassGraph& graph, const std::string& name, Format format, glm::uvec2 extent, bool is_cleared) {
    const Image target = graph.image_black_at_first(name, format, extent);
    if (is_cleared) graph.clear(target, {});
    return target;
}

void draw_mask(PassGraph::Pass& pass, const Image& mask) {
    if (mask.format == Format::d16)
        pass.depth({.compare = DepthTest::Compare::always, .is_written = true, .image = mask});
    else
        pass.stencil({.mode = Stencil::Mode::write, .value = kept_stencil, .image = mask});
    pass.run();
}

void draw_masked(PassGraph::Pass& pass, const Image& mask) {
    // Kept pixels hold a depth of 1; the triangle lies at depth 0.
    if (mask.format == Format::d16)
        pass.depth({.compare = DepthTest::Compare::less, .is_written = false, .image = mask});
    else
        pass.stencil({.mode = Stencil::Mode::keep_equal, .value = kept_stencil, .image = mask});
    pass.run();
}
