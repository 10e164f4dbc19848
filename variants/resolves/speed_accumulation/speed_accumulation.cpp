#include "variants/resolves/resolve.h"
#include "variants/resolves/speed_accumulation/parameters.h"

namespace {

class SpeedAccumulation final : public Resolve {
public:
    Reflections run(PassGraph& graph, const GBuffer& gbuffer, const ResolvedRays& rays) override {
        const Buffer seen = see_rays(graph, gbuffer, rays);
        use_own_params(graph, rays.draw.values());
        const PassGraph::History accumulated = graph.history("accumulated", Format::rgba32f),
                                 age = graph.history("age", Format::r32f);
        const Image gathered = graph.image("gathered", Format::rgba32f),
                    target_motion = graph.image("target_motion", Format::rgba32f),
                    reflections = graph.image("reflections", Format::rgba32f);
        graph.compute("resolves/speed_accumulation/gather.comp")
            .use(rays.traced.directions)
            .use(rays.traced.hits)
            .use(seen)
            .write(gathered)
            .write(target_motion)
            .run();
        graph.compute("resolves/speed_accumulation/accumulate.comp")
            .read(gathered)
            .read(target_motion)
            .read(accumulated.previous)
            .read(age.previous)
            .write(accumulated.current)
            .write(age.current)
            .write(reflections)
            .run();
        return {reflections, reflections, 3};
    }

    std::vector<std::string> stages() const override {
        return {"resolves/see_rays", "resolves/speed_accumulation/gather", "resolves/speed_accumulation/accumulate"};
    }
    StageReads reads() const override {
        const std::string gather = "resolves/speed_accumulation/gather",
                          accumulate = "resolves/speed_accumulation/accumulate";
        StageReads reads{.rays = "resolves/see_rays", .motion = {gather}, .specular = {gather, accumulate}};
        if (accumulation_.temporal_accumulation) reads.motion.push_back(accumulate);
        return reads;
    }

private:
    SpeedAccumulationParameters accumulation_{params};
    RayDrawParameters draw_{params};
};

}  // namespace

ResolveEntry speed_accumulation_resolve() {
    return {.name = "speed_accumulation",
            .title = "A long mean of frames that speed cuts short",
            .source = "Unity HDRP (2021-09), screen-space reflection with PBR accumulation; formulas alone",
            .description =
                "The mean of the rays of five pixels, blended into what the same pixel reflected before; the faster "
                "the surface or what its ray met moves, the less of that is left.",
            .folder = "variants/resolves/speed_accumulation/",
            .declare = [](ParameterSet& params) { SpeedAccumulationParameters{params}; },
            .create = [] { return std::make_unique<SpeedAccumulation>(); }};
}
