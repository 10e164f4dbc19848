#include "variants/resolves/ratio_filter/parameters.h"
#include "variants/resolves/resolve.h"

namespace {

class RatioFilter final : public Resolve {
public:
    Reflections run(PassGraph& graph, const GBuffer& gbuffer, const ResolvedRays& rays) override {
        const Buffer seen = see_rays(graph, gbuffer, rays);
        use_own_params(graph, rays.draw.values());
        const Image resolved = graph.image("resolved", Format::rgba32f),
                    resolved_variance = graph.image("resolved_variance", Format::r32f),
                    resolved_length = graph.image("resolved_length", Format::r32f),
                    reflections = graph.image("reflections", Format::rgba32f);
        const PassGraph::History accumulated = graph.history("accumulated", Format::rgba32f),
                                 variance = graph.history("accumulated_variance", Format::r32f);
        graph.compute("resolves/ratio_filter/spatial.comp")
            .use(rays.traced.directions)
            .use(rays.traced.hits)
            .use(seen)
            .write(resolved)
            .write(resolved_variance)
            .write(resolved_length)
            .run();
        graph.compute("resolves/ratio_filter/temporal.comp")
            .read(gbuffer.motion)
            .read(resolved)
            .read(resolved_variance)
            .read(resolved_length)
            .read(accumulated.previous)
            .read(variance.previous)
            .write(accumulated.current)
            .write(variance.current)
            .run();
        graph.compute("resolves/ratio_filter/bilateral.comp")
            .read(accumulated.current.as("accumulated"))
            .read(variance.current.as("accumulated_variance"))
            .write(reflections)
            .run();
        return {reflections, reflections, 3};
    }

    std::vector<std::string> stages() const override {
        return {"resolves/see_rays", "resolves/ratio_filter/spatial", "resolves/ratio_filter/temporal",
                "resolves/ratio_filter/bilateral"};
    }
    bool draws_random_numbers() const override { return filter_.spatial_reuse || filter_.bilateral_filter; }
    StageReads reads() const override {
        StageReads reads{.rays = "resolves/see_rays", .motion = {}, .specular = {"resolves/ratio_filter/spatial"}};
        if (filter_.temporal_accumulation && filter_.follow_motion) reads.motion = {"resolves/ratio_filter/temporal"};
        return reads;
    }

private:
    RatioFilterParameters filter_{params};
    RayDrawParameters draw_{params};
};

}  // namespace

ResolveEntry ratio_filter_resolve() {
    return {
        .name = "ratio_filter",
        .title = "EEVEE's ratio of densities, history and bilateral filter",
        .source =
            "Blender, EEVEE's denoising of rays (commit 14c380e9, and its predecessor 3b3a5731), GPL: by its formulas",
        .description =
            "Up to 16 neighbours' rays, weighed by the density of the pixel's own lobe over theirs; history from where "
            "the surface and where its mirror image was, each as well as it goes with the neighbours; neighbours on "
            "the same plane where the variance is high.",
        .folder = "variants/resolves/ratio_filter/",
        .declare = [](ParameterSet& params) { RatioFilterParameters{params}; },
        .create = [] { return std::make_unique<RatioFilter>(); }};
}
