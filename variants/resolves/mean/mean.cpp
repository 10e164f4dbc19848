#include "variants/resolves/resolve.h"

namespace {

class Mean final : public Resolve {
public:
    Reflections run(PassGraph& graph, const GBuffer& gbuffer, const ResolvedRays& rays) override {
        const Image radiance = average_own_rays(graph, gbuffer, rays).radiance;
        return {radiance, radiance, 3};
    }
    std::vector<std::string> stages() const override { return {"resolves/own_rays"}; }
    StageReads reads() const override {
        return {.rays = "resolves/own_rays", .motion = {}, .specular = {"resolves/own_rays"}};
    }
};

}  // namespace

ResolveEntry mean_resolve() {
    return {
        .name = "mean",
        .title = "The mean of a pixel's own rays",
        .source = "introduction of Stachowiak & Uludag 2015, Stochastic Screen-Space Reflections, as quoted by others",
        .description = "No neighbours and no history: what the rays alone are worth.",
        .folder = "variants/resolves/mean/",
        .needs_density = false,
        .create = [] { return std::make_unique<Mean>(); }};
}
