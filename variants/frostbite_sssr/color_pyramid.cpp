#include "variants/frostbite_sssr/passes.h"

#include <algorithm>
#include <bit>

Image frostbite_color_pyramid(PassGraph& graph, const Image& color) {
    const unsigned mips = unsigned(std::bit_width(std::max(color.extent.x, color.extent.y)));
    const Image pyramid = graph.image_of("color_pyramid", Format::rgba32f, color.extent, mips);
    for (unsigned level = 0; level < mips; ++level)
        graph.compute("frostbite_sssr/color_pyramid.comp")
            .read((level == 0 ? color : pyramid.mip(level - 1)).as("finer"))
            .write(pyramid.mip(level).as("coarser"))
            .run();
    return pyramid;
}
