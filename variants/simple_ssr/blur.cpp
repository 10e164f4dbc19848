#include "variants/simple_ssr/blur.h"

Image simple_blur(PassGraph& graph, const Image& sharp) {
    const Image blurred_rows = graph.image("blurred_rows", Format::rgba32f),
                blurred = graph.image("blurred", Format::rgba32f);
    const auto blur = [&](const Image& from, const Image& to, unsigned axis) {
        graph.compute("simple_ssr/blur.comp")
            .read(from.as("sharp"))
            .write(to.as("result"))
            .set("axis", axis)
            .label(axis == 0 ? "simple_ssr/blur_rows" : "simple_ssr/blur_columns")
            .run();
    };
    blur(sharp, blurred_rows, 0);
    blur(blurred_rows, blurred, 1);
    return blurred;
}
