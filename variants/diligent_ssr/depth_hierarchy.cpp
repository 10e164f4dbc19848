#include "variants/diligent_ssr/passes.h"

#include <algorithm>
#include <bit>

namespace {

constexpr unsigned max_mips = 7;
const std::string stage = "diligent_ssr/depth_hierarchy";

void copy_level(PassGraph& graph, const Image& source, const Image& target, unsigned level) {
    graph.fragment("diligent_ssr/copy_level.frag")
        .label(stage)
        .read(source.as("copied"))
        .write(target.mip(level).as("copied_depth"))
        .set("level", int(level))
        .run();
}

/// `finer_level`: of the image `finer`, which is that level alone or the whole chain.
void draw_level(PassGraph& graph, const Image& finer, unsigned finer_level, const Image& target) {
    graph.fragment("diligent_ssr/depth_hierarchy.frag")
        .label(stage)
        .read(finer.as("finer_depth"))
        .write(target.as("nearest_depth"))
        .set("finer_level", int(finer_level))
        .run();
}

}  // namespace

Image diligent_depth_hierarchy(PassGraph& graph, const GBuffer& gbuffer, const DiligentTracingParameters& parameters) {
    const glm::uvec2 extent = gbuffer.depth.extent;
    const unsigned mips = std::min(max_mips, unsigned(std::bit_width(std::max(extent.x, extent.y))));
    const Image hierarchy = graph.image_of("depth_hierarchy", Format::r32f, extent, mips);
    copy_level(graph, gbuffer.depth, hierarchy, 0);
    if (parameters.hierarchy.is("mip_views")) {
        for (unsigned level = 1; level < mips; ++level)
            draw_level(graph, hierarchy.mip(level - 1), 0, hierarchy.mip(level));
        return hierarchy;
    }
    // The original copies the last level, too, which nothing reads.
    const Image intermediate = graph.image_of("depth_hierarchy_intermediate", Format::r32f, extent, mips);
    for (unsigned level = 1; level < mips; ++level) {
        copy_level(graph, hierarchy, intermediate, level - 1);
        draw_level(graph, intermediate, level - 1, hierarchy.mip(level));
    }
    return hierarchy;
}
