#include "core/gbuffer/environment_images.h"
#include "variants/resolves/ratio_filter/parameters.h"
#include "variants/resolves/resolve.h"

namespace {

class RatioFilter final : public Resolve {
public:
    Reflections run(PassGraph& graph, const GBuffer& gbuffer, const ResolvedRays& rays) override {
        const Image ray_seen = see_rays(graph, gbuffer, rays);
        use_own_params(graph, rays.draw.values());
        const Image resolved = graph.image("resolved", Format::rgba32f),
                    resolved_variance = graph.image("resolved_variance", Format::r32f),
                    resolved_length = graph.image("resolved_length", Format::r32f),
                    reflections = graph.image("reflections", Format::rgba32f);
        const PassGraph::History accumulated = graph.history("accumulated", Format::rgba32f),
                                 variance = graph.history("accumulated_variance", Format::r32f);
        graph.compute("resolves/ratio_filter/spatial.comp")
            .read(ray_seen)
            .use(rays.traced.directions)
            .use(rays.traced.hits)
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
        return {"resolves/ratio_filter/rays", "resolves/ratio_filter/spatial", "resolves/ratio_filter/temporal",
                "resolves/ratio_filter/bilateral"};
    }
    bool draws_random_numbers() const override { return filter_.spatial_reuse || filter_.bilateral_filter; }
    bool filters_by_motion() const override { return filter_.temporal_accumulation && filter_.follow_motion; }

private:
    static Image see_rays(PassGraph& graph, const GBuffer& gbuffer, const ResolvedRays& rays) {
        const glm::uvec2 screen = graph.extent(), traced = rays.draw.half_resolution ? (screen + 1u) / 2u : screen;
        const Image ray_seen =
            graph.image_of("ray_seen", Format::rgba32f, {traced.x * unsigned(rays.draw.max_rays), traced.y});
        PassGraph::Pass pass = graph.compute("resolves/ratio_filter/rays.comp");
        pass.read(rays.color.as("hit_color")).use(rays.traced.directions).use(rays.traced.hits).write(ray_seen);
        bind_environment(pass, gbuffer).run(traced);
        return ray_seen;
    }

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
