#include "variants/resolves/reservoirs/passes.h"

Reflections reservoirs(PassGraph& graph, const GBuffer& gbuffer, const RayImages& rays) {
    const PassGraph::History radiance = graph.history("reservoir_radiance", Format::rgba32f),
                             hit = graph.history("reservoir_hit", Format::rgba32f),
                             origin = graph.history("reservoir_origin", Format::rgba32f);
    graph.compute("resolves/reservoirs/temporal.comp")
        .read(rays.radiance)
        .read(rays.direction)
        .read(gbuffer.motion)
        .read(gbuffer.fallback)
        .read(radiance.previous)
        .read(hit.previous)
        .read(origin.previous)
        .write(radiance.current)
        .write(hit.current)
        .write(origin.current)
        .run();
    const Image reflections = graph.image("reflections", Format::rgba32f);
    graph.compute("resolves/reservoirs/resolve.comp")
        .read(radiance.current)
        .read(hit.current)
        .read(origin.current)
        .write(reflections)
        .run();
    return {reflections, reflections, 3};
}

namespace {

class Reservoirs final : public Resolve {
public:
    Reflections run(PassGraph& graph, const GBuffer& gbuffer, const ResolvedRays& rays) override {
        const RayImages images = ray_images(graph, gbuffer, rays);
        use_own_params(graph, rays.draw.values());
        return reservoirs(graph, gbuffer, images);
    }

    std::vector<std::string> stages() const override {
        return {"resolves/ray_images", "resolves/reservoirs/temporal", "resolves/reservoirs/resolve"};
    }
    bool draws_random_numbers() const override { return reservoirs_.temporal_reuse || reservoirs_.spatial_reuse; }
    StageReads reads() const override {
        StageReads reads{.rays = "resolves/ray_images", .motion = {}, .specular = stages()};
        if (reservoirs_.temporal_reuse) reads.motion = {"resolves/reservoirs/temporal"};
        return reads;
    }

private:
    ReservoirParameters reservoirs_{params};
    RayDrawParameters draw_{params};
};

}  // namespace

ResolveEntry reservoirs_resolve() {
    return {.name = "reservoirs",
            .title = "Reservoirs of rays over time, and a ratio estimator over neighbours' reservoirs",
            .source = "kajiya (2025-07), MIT or Apache-2.0 licence, Copyright (c) 2019 Embark Studios",
            .description =
                "Each pixel keeps one ray of those that it had, by what it sees times its density; neighbours' rays "
                "are seen from each pixel and weighed by its lobe. What rays do not know is the fallback.",
            .folder = "variants/resolves/reservoirs/",
            .declare = [](ParameterSet& params) { ReservoirParameters{params}; },
            .create = [] { return std::make_unique<Reservoirs>(); }};
}
