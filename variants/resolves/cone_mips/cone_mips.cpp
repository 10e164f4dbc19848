#include "variants/resolves/cone_mips/passes.h"

#include <algorithm>
#include <bit>

Reflections cone_mips(PassGraph& graph, const OwnRays& own, bool half_resolution) {
    const glm::uvec2 screen = graph.extent(), extent = half_resolution ? (screen + 1u) / 2u : screen;
    const unsigned levels = unsigned(std::bit_width(std::min(extent.x, extent.y)));
    const Image mips = graph.image_of("reflection_mips", Format::rgba32f, extent, levels),
                level = graph.image_of("cone_level", Format::r32f, extent),
                reflections = graph.image("reflections", Format::rgba32f);
    graph.compute("resolves/cone_mips/compress.comp")
        .read(own.radiance)
        .read(own.ray_length)
        .write(mips.mip(0).as("finest"))
        .write(level)
        .set("last_level", float(levels - 1))
        .run();
    for (unsigned i = 1; i < levels; ++i)
        graph.compute("resolves/cone_mips/blur.comp")
            .read_linear(mips.mip(i - 1).as("finer"))
            .write(mips.mip(i).as("coarser"))
            .set("level", float(i))
            .run();
    graph.compute("resolves/cone_mips/fetch.comp")
        .read(own.radiance)
        .read_linear(mips)
        .read(level)
        .write(reflections)
        .run();
    return {reflections, reflections, 3};
}

namespace {

class ConeMips final : public Resolve {
public:
    Reflections run(PassGraph& graph, const GBuffer& gbuffer, const ResolvedRays& rays) override {
        const OwnRays own = average_own_rays(graph, gbuffer, rays);
        use_own_params(graph, rays.draw.values());
        return cone_mips(graph, own, rays.draw.half_resolution);
    }

    std::vector<std::string> stages() const override {
        return {"resolves/own_rays", "resolves/cone_mips/compress", "resolves/cone_mips/blur",
                "resolves/cone_mips/fetch"};
    }
    StageReads reads() const override {
        return {.rays = "resolves/own_rays",
                .motion = {},
                .specular = {"resolves/own_rays", "resolves/cone_mips/compress", "resolves/cone_mips/fetch"}};
    }

private:
    ConeMipsParameters mips_{params};
    RayDrawParameters draw_{params};
};

}  // namespace

ResolveEntry cone_mips_resolve() {
    return {.name = "cone_mips",
            .title = "Mips of the picture of reflections, chosen by a cone",
            .source = "Godot 4.6, MIT licence, Copyright (c) 2014-present Godot Engine contributors",
            .description =
                "What mirror rays see is blurred level by level; a pixel shows the level that is as wide as the cone "
                "of its roughness where its ray ends. No history.",
            .folder = "variants/resolves/cone_mips/",
            .needs_density = false,
            .declare = [](ParameterSet& params) { ConeMipsParameters{params}; },
            .create = [] { return std::make_unique<ConeMips>(); }};
}
