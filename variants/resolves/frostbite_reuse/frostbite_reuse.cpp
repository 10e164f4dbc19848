#include "core/gbuffer/split_sum_image.h"
#include "variants/frostbite_sssr/passes.h"
#include "variants/resolves/resolve.h"

namespace {

/// Reuse of neighbours' rays and temporal filter of frostbite_sssr.
class FrostbiteReuse final : public Resolve {
public:
    Reflections run(PassGraph& graph, const GBuffer& gbuffer, const ResolvedRays& rays) override {
        nlohmann::json given = rays.draw.values();
        given["misses"] = rays.misses_are_known ? "fallback" : "weight";
        given["previous_frame"] = rays.previous_frame;
        use_own_params(graph, given);
        const Image color = resolve_.filtered_sampling ? frostbite_color_pyramid(graph, rays.color) : rays.color;
        const Image split_sum = split_sum_.on(graph);
        const FrostbiteResolved resolved =
            frostbite_resolve(graph, gbuffer, color, split_sum, rays.below_horizon, rays.traced, resolve_);
        const Image reflections = frostbite_accumulate(graph, gbuffer, split_sum, resolved, resolve_);
        return {reflections, reflections, 3};
    }

    std::vector<std::string> stages() const override {
        std::vector<std::string> stages = {"frostbite_sssr/resolve"};
        if (resolve_.filtered_sampling) stages.insert(stages.begin(), "frostbite_sssr/color_pyramid");
        if (resolve_.temporal_filter || !resolve_.reflectance_after_filter)
            stages.push_back("frostbite_sssr/accumulate");
        return stages;
    }
    bool draws_random_numbers() const override { return !resolve_.taps.is("1") && resolve_.pattern.is("rotated"); }
    StageReads reads() const override {
        StageReads reads{.rays = "frostbite_sssr/resolve", .motion = {}, .specular = {}};
        if (resolve_.temporal_filter) reads.motion = {"frostbite_sssr/accumulate"};
        return reads;
    }

private:
    FrostbiteResolveParameters resolve_{params};
    RayDrawParameters draw_{params};
    SplitSumImage split_sum_;
};

}  // namespace

ResolveEntry frostbite_reuse_resolve() {
    return {.name = "frostbite_reuse",
            .title = "Frostbite's reuse of neighbours' rays and temporal filter",
            .source = "Stachowiak & Uludag 2015, Stochastic Screen-Space Reflections",
            .description =
                "Each pixel weighs its neighbours' rays by its own lobe over their densities; colours as wide as the "
                "lobe's cone; history from where the mirror image was, in the box of the neighbours.",
            .folder = "variants/resolves/frostbite_reuse/",
            .takes_probe = false,
            .declare = [](ParameterSet& params) { FrostbiteResolveParameters{params}; },
            .given = {"misses", "previous_frame"},
            .create = [] { return std::make_unique<FrostbiteReuse>(); }};
}
