#include "variants/common/depth_pyramid.h"

#include <algorithm>
#include <bit>

Image depth_pyramid(PassList& pass_list, const Image& depth, unsigned mips, bool keeps_farthest) {
    const glm::uvec2 extent = depth.extent;
    mips = std::min(mips, unsigned(std::bit_width(std::max(extent.x, extent.y))));
    const Image pyramid =
        pass_list.image_of(keeps_farthest ? "farthest_depth_pyramid" : "depth_pyramid", Format::r32f, extent, mips);
    const glm::uvec2 groups = (extent + 63u) / 64u;
    PassList::Pass pass = pass_list.compute("common/depth_pyramid.comp");
    pass.read(depth).use(pass_list.buffer("depth_pyramid_counter", 4));
    pass.set("level_count", mips)
        .set("group_count", groups.x * groups.y)
        .set("keeps_farthest", unsigned(keeps_farthest));
    // A shader's bindings must all exist; what stands for levels that the pyramid lacks is never written.
    const Image missing = pass_list.image_of("missing_mip", Format::r32f, {1, 1});
    for (unsigned level = 0; level < 13; ++level)
        pass.write((level < mips ? pyramid.mip(level) : missing).as("mip_" + std::to_string(level)));
    pass.dispatch_groups({groups, 1});
    return pyramid;
}
