#include "variants/diligent_ssr/passes.h"
#include "variants/resolves/resolve.h"

namespace {

/// The three filters of diligent_ssr behind its mask. Rays hold radiance times confidence, as with
/// premultiply_confidence.
class DiligentFilters final : public Resolve {
public:
    Reflections run(PassGraph& graph, const GBuffer& gbuffer, const ResolvedRays& rays) override {
        const RayImages images = ray_images(graph, gbuffer, rays);
        use_own_params(graph, {{"roughness_threshold", float(rays.draw.max_roughness)},
                               {"float_roughness", true},
                               {"premultiply_confidence", true},
                               {"distribution_floor", false},  // nor is it in the densities of the rays
                               {"half_resolution", false}});
        const Image reprojected_depth = diligent_reprojected_depth(graph, gbuffer);
        const DiligentMask mask = diligent_mask(graph, gbuffer, tracing_, filter_);
        const DiligentResolved resolved =
            diligent_reconstruct(graph, gbuffer, {images.radiance, images.direction}, mask, filter_);
        const DiligentHistories histories = diligent_histories(graph, filter_);
        diligent_accumulate(graph, gbuffer, reprojected_depth, resolved, histories, mask, filter_);
        const Image reflections =
            diligent_cleanup(graph, gbuffer, histories.radiance.current, histories.variance.current, mask, filter_);
        return {reflections, reflections, 3};
    }

    std::vector<std::string> stages() const override {
        const bool is_guided = filter_.bilateral_cleanup && filter_.cleanup.is("guided");
        std::vector<std::string> stages = {"resolves/ray_images", "diligent_ssr/reprojected_depth", "diligent_ssr/mask",
                                           "diligent_ssr/spatial_reconstruction", "diligent_ssr/temporal_accumulation"};
        if (is_guided) stages.push_back("diligent_ssr/guided_coefficients");
        stages.push_back(is_guided ? "diligent_ssr/guided_cleanup" : "diligent_ssr/bilateral_cleanup");
        return stages;
    }
    StageReads reads() const override {
        const std::string rays = "resolves/ray_images";
        StageReads reads{.rays = rays, .motion = {}, .specular = {rays, "diligent_ssr/mask"}};
        if (filter_.temporal_accumulation) reads.motion = {"diligent_ssr/temporal_accumulation"};
        return reads;
    }

private:
    DiligentFilterParameters filter_{params};
    DiligentTracingParameters tracing_{params};
};

}  // namespace

ResolveEntry diligent_filters_resolve() {
    return {.name = "diligent_filters",
            .title = "DiligentFX's spatial reconstruction, temporal accumulation and bilateral cleanup",
            .source = "DiligentFX (2026-07), Apache-2.0 licence, Copyright Diligent Graphics LLC",
            .description =
                "Rays of eight neighbours by the ratio estimator, history from where the surface or its mirror image "
                "was, and a bilateral filter where the variance is high.",
            .folder = "variants/resolves/diligent_filters/",
            .declare = [](ParameterSet& params) { DiligentFilterParameters{params}; },
            .given = {"distribution_floor", "scale_radius", "nearest_half_rays"},
            .create = [] { return std::make_unique<DiligentFilters>(); }};
}
