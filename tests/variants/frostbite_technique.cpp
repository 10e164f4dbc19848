#include "tests/variants/frostbite_technique.h"

#include "variants/registry.h"

namespace {

const Declaration& frostbite() { return declared_technique("frostbite_sssr"); }

}  // namespace

Image frostbite_color_pyramid(PassList& pass_list, const Image& color) {
    const auto whole = make_technique("frostbite_sssr");  // whose defaults say which images there are
    TechniquePasses passes(frostbite(), pass_list, {}, whole->params, {{"hit_color", color}});
    passes.run("color_pyramid");
    return passes.image("color_pyramid");
}

FrostbiteTiles frostbite_classify(PassList& pass_list, const GBuffer& gbuffer, const Tracers::Images& images,
                                  const Image& color, const FrostbiteRayParameters& parameters, RayProbe* probe) {
    TechniquePasses passes(frostbite(), pass_list, gbuffer, parameters.params, {{"hit_color", color}}, {},
                           &parameters.tracers, probe);
    passes.list.set_pyramids(images);
    if (value_of(parameters.params, "classification") == true)
        passes.run("classify");
    else
        passes.clear("ray_count");
    return {passes.image("ray_count")};
}

FrostbiteWork frostbite_allocate(PassList& pass_list, const GBuffer& gbuffer, const FrostbiteTiles& tiles,
                                 const FrostbiteRayParameters& parameters) {
    TechniquePasses passes(frostbite(), pass_list, gbuffer, parameters.params, {{"ray_count", tiles.ray_count}});
    passes.clear("counters");
    passes.run("allocate");
    const auto& list = passes.list;
    const unsigned divisor = parameters.half_resolution ? 2 : 1;
    return {list.buffer("smooth_list"), list.buffer("rough_list"), list.buffer("counters"),
            list.buffer("indirect_arguments"), (pass_list.extent() + divisor - 1u) / divisor};
}

TracedRays frostbite_trace(PassList& pass_list, const Tracers::Images& images, const FrostbiteWork& work,
                           const Image& below_horizon, const FrostbiteRayParameters& parameters, RayProbe* probe) {
    TechniquePasses passes(frostbite(), pass_list, {}, parameters.params, {{"below_horizon", below_horizon}},
                           {{"smooth_list", work.smooth_list},
                            {"rough_list", work.rough_list},
                            {"counters", work.counters},
                            {"indirect_arguments", work.indirect_arguments}},
                           &parameters.tracers, probe);
    passes.list.set_pyramids(images);
    passes.clear("directions");
    passes.run("trace_smooth");
    passes.run("trace_rough");
    return {passes.list.buffer("directions"), passes.list.buffer("hits")};
}

FrostbiteResolved frostbite_resolve(PassList& pass_list, const GBuffer& gbuffer, const Image& color,
                                    const Image& split_sum, const Image& below_horizon, const TracedRays& rays,
                                    const FrostbiteResolveParameters& parameters) {
    TechniquePasses passes(frostbite(), pass_list, gbuffer, parameters.params,
                           {{"color_pyramid", color}, {"split_sum", split_sum}, {"below_horizon", below_horizon}},
                           {{"directions", rays.directions}, {"hits", rays.hits}});
    passes.run("resolve");
    return {passes.image("resolved_radiance"), passes.image("resolved_length")};
}

Image frostbite_accumulate(PassList& pass_list, const GBuffer& gbuffer, const Image& split_sum,
                           const FrostbiteResolved& resolved, const FrostbiteResolveParameters& parameters) {
    TechniquePasses passes(frostbite(), pass_list, gbuffer, parameters.params,
                           {{"split_sum", split_sum},
                            {"resolved_radiance", resolved.radiance},
                            {"resolved_length", resolved.reflection_depth}});
    if (passes.list.known().by_name().at("accumulates") != true) return resolved.radiance;
    passes.run("accumulate");
    return passes.image("reflections");
}
