#include "core/gbuffer/environment_images.h"
#include "variants/resolves/ratio_accumulation/parameters.h"
#include "variants/resolves/resolve.h"

namespace {

class RatioAccumulation final : public Resolve {
public:
    Reflections run(PassGraph& graph, const GBuffer& gbuffer, const ResolvedRays& rays) override {
        const Buffer seen = see_rays(graph, gbuffer, rays);
        nlohmann::json given = rays.draw.values();
        given["rough_from_probe"] = rays.probe.has_value();
        use_own_params(graph, given);
        const PassGraph::History accumulated = graph.history("accumulated", Format::rgba32f),
                                 moments = graph.history("moments", Format::rgba32f),
                                 lengths = graph.history("reflected_length", Format::r32f);
        PassGraph::Pass pass = graph.compute("resolves/ratio_accumulation/accumulate.comp");
        pass.use(rays.traced.directions)
            .use(rays.traced.hits)
            .use(seen)
            .read(accumulated.previous)
            .read(moments.previous)
            .read(lengths.previous)
            .write(accumulated.current)
            .write(moments.current)
            .write(lengths.current);
        const glm::uvec2 screen = graph.extent();
        bind_probe(pass, rays).run(rays.draw.half_resolution ? (screen + 1u) / 2u : screen);
        return {accumulated.current, accumulated.current, 3};
    }

    std::vector<std::string> stages() const override {
        return {"resolves/see_rays", "resolves/ratio_accumulation/accumulate"};
    }
    StageReads reads() const override {
        const std::string accumulate = "resolves/ratio_accumulation/accumulate";
        StageReads reads{.rays = "resolves/see_rays", .motion = {}, .specular = {accumulate}};
        if (accumulation_.temporal_accumulation) reads.motion = {accumulate};
        return reads;
    }

    bool answers_rough_surfaces() const override { return true; }

private:
    RatioAccumulationParameters accumulation_{params};
    RayDrawParameters draw_{params};
};

}  // namespace

ResolveEntry ratio_accumulation_resolve() {
    return {
        .name = "ratio_accumulation",
        .title = "A ratio of densities over pixels and frames",
        .source = "ssrlab",
        .description =
            "The rays of five traced pixels, weighed by the density of the pixel's own lobe over theirs, are added to "
            "those of the frames before, weighed alike, until what they see changes.",
        .folder = "variants/resolves/ratio_accumulation/",
        .declare = [](ParameterSet& params) { RatioAccumulationParameters{params}; },
        .given = {"rough_from_probe"},
        .create = [] { return std::make_unique<RatioAccumulation>(); }};
}
