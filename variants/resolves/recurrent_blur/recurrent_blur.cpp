#include "variants/resolves/recurrent_blur/parameters.h"
#include "variants/resolves/recurrent_blur/passes.h"

Image recurrent_blur(PassGraph& graph, const GBuffer& gbuffer, const OwnRays& own) {
    const PassGraph::History blurred = graph.history("blurred", Format::rgba32f),
                             age = graph.history("age", Format::r32f);
    const Image reprojected = graph.image("reprojected", Format::rgba32f),
                reprojected_age = graph.image("reprojected_age", Format::r32f),
                reflections = graph.image("reflections", Format::rgba32f);
    graph.compute("resolves/recurrent_blur/reproject.comp")
        .read(own.radiance)
        .read(own.ray_length)
        .read(gbuffer.motion)
        .read(gbuffer.previous_depth)
        .read(gbuffer.previous_normal)
        .read(blurred.previous)
        .read(age.previous)
        .write(reprojected)
        .write(reprojected_age)
        .run();
    graph.compute("resolves/recurrent_blur/blur.comp")
        .read(own.radiance)
        .read(own.ray_length)
        .read(reprojected)
        .read(reprojected_age)
        .write(blurred.current)
        .write(age.current)
        .write(reflections)
        .run();
    return reflections;
}

namespace {

class RecurrentBlur final : public Resolve {
public:
    Reflections run(PassGraph& graph, const GBuffer& gbuffer, const ResolvedRays& rays) override {
        const OwnRays own = average_own_rays(graph, gbuffer, rays);
        use_own_params(graph, {{"max_roughness", float(rays.draw.max_roughness)}});
        const Image reflections = recurrent_blur(graph, gbuffer, own);
        return {reflections, reflections, 3};
    }

    std::vector<std::string> stages() const override {
        return {"resolves/own_rays", "resolves/recurrent_blur/reproject", "resolves/recurrent_blur/blur"};
    }
    bool draws_random_numbers() const override { return blur_.spatial_filter; }
    StageReads reads() const override {
        StageReads reads{.rays = "resolves/own_rays", .motion = {}, .specular = stages()};
        if (blur_.temporal_accumulation) reads.motion = {"resolves/recurrent_blur/reproject"};
        return reads;
    }

private:
    RecurrentBlurParameters blur_{params};
    RayDrawParameters draw_{params};
};

}  // namespace

ResolveEntry recurrent_blur_resolve() {
    return {
        .name = "recurrent_blur",
        .title = "A blur that is blurred again in each frame, by a disk that shrinks with its age",
        .source = "three.js, RecurrentDenoiseNode (2026-06, MIT licence), after Zhdan 2021, ReBLUR",
        .description =
            "History from where the surface or its mirror image was; eight neighbours, on a disk as wide as rays are "
            "long, are averaged in it and in the new rays, and both are blended.",
        .folder = "variants/resolves/recurrent_blur/",
        .needs_density = false,
        .declare = [](ParameterSet& params) { RecurrentBlurParameters{params}; },
        .create = [] { return std::make_unique<RecurrentBlur>(); }};
}
