#include "variants/simple_ssr/blur.h"

#include "variants/resolves/resolve.h"

namespace {

class Blur final : public Resolve {
public:
    Reflections run(PassGraph& graph, const GBuffer& gbuffer, const ResolvedRays& rays) override {
        const Image sharp = average_own_rays(graph, gbuffer, rays).radiance;
        use_own_params(graph, {{"max_roughness", float(rays.draw.max_roughness)}});
        const Image blurred = simple_blur(graph, sharp);
        return {blurred, blurred, 3};
    }
    std::vector<std::string> stages() const override {
        return {"resolves/own_rays", "simple_ssr/blur_rows", "simple_ssr/blur_columns"};
    }
    StageReads reads() const override { return {.rays = "resolves/own_rays", .motion = {}, .specular = stages()}; }

private:
    SimpleBlurParameters blur_{params};
    RayDrawParameters draw_{params};
};

}  // namespace

ResolveEntry blur_resolve() {
    return {.name = "blur",
            .title = "A blur of one size for near and far, by roughness",
            .source = "Killzone Shadow Fall, in the introduction of Stachowiak & Uludag 2015, as quoted by others",
            .description = "The mean of the pixel's own rays, then of all neighbours in a square.",
            .folder = "variants/resolves/blur/",
            .needs_density = false,
            .declare = [](ParameterSet& params) { SimpleBlurParameters{params}; },
            .create = [] { return std::make_unique<Blur>(); }};
}
