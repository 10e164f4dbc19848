#include "variants/common/drawn_pyramid/drawn_pyramid.h"

#include <algorithm>
#include <bit>

namespace {

void copy_level(PassList& pass_list, const Image& source, const Image& target, unsigned level) {
    pass_list.fragment("diligent_ssr/copy_level.frag")
        .label(drawn_pyramid_stage)
        .read(source.as("copied"))
        .write(target.mip(level).as("copied_depth"))
        .set("level", int(level))
        .run();
}

void copy_surfaces(PassList& pass_list, const Image& depth, const Image& target) {
    pass_list.fragment("diligent_ssr/copy_surfaces.frag")
        .label(drawn_pyramid_stage)
        .read(depth.as("copied"))
        .write(target.as("copied_depth"))
        .run();
}

/// `finer_level`: of the image `finer`, which is that level alone or the whole chain.
void draw_level(PassList& pass_list, const Image& finer, unsigned finer_level, const Image& target,
                bool keeps_farthest) {
    pass_list.fragment("diligent_ssr/depth_hierarchy.frag")
        .label(drawn_pyramid_stage)
        .read(finer.as("finer_depth"))
        .write(target.as("kept_depth"))
        .set("finer_level", int(finer_level))
        .set("keeps_farthest", int(keeps_farthest))
        .run();
}

}  // namespace

Image drawn_pyramid(PassList& pass_list, const Image& depth, unsigned max_mips, bool keeps_farthest,
                    bool has_mip_views) {
    const glm::uvec2 extent = depth.extent;
    const unsigned mips = std::min(max_mips, unsigned(std::bit_width(std::max(extent.x, extent.y))));
    const std::string name = keeps_farthest ? "farthest_depth_pyramid" : "depth_pyramid";
    const Image hierarchy = pass_list.image_of(name, Format::r32f, extent, mips);
    if (keeps_farthest)
        copy_surfaces(pass_list, depth, hierarchy.mip(0));
    else
        copy_level(pass_list, depth, hierarchy, 0);
    if (has_mip_views) {
        for (unsigned level = 1; level < mips; ++level)
            draw_level(pass_list, hierarchy.mip(level - 1), 0, hierarchy.mip(level), keeps_farthest);
        return hierarchy;
    }
    // The original copies the last level, too, which nothing reads.
    const Image intermediate = pass_list.image_of(name + "_intermediate", Format::r32f, extent, mips);
    for (unsigned level = 1; level < mips; ++level) {
        copy_level(pass_list, hierarchy, intermediate, level - 1);
        draw_level(pass_list, intermediate, level - 1, hierarchy.mip(level), keeps_farthest);
    }
    return hierarchy;
}
