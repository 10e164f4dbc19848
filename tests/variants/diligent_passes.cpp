#include "tests/variants/diligent_passes.h"

namespace {

const Declaration& diligent() { return declared_technique("diligent_ssr"); }

std::map<std::string, Image> images_of(const DiligentMask& mask) {
    std::map<std::string, Image> images = {{"roughness", mask.roughness}, {"mask", mask.full}};
    if (mask.traced.storage != mask.full.storage) images["half_resolution_mask"] = mask.traced;
    return images;
}

}  // namespace

DiligentHistories diligent_histories(PassList& pass_list, const DiligentFilterParameters& parameters) {
    const bool is_float = parameters.float_histories;
    return {.radiance = pass_list.history("accumulated_radiance", is_float ? Format::rgba32f : Format::rgba16f),
            .variance = pass_list.history("accumulated_variance", is_float ? Format::r32f : Format::r16f)};
}

Image diligent_reprojected_depth(PassList& pass_list, const GBuffer& gbuffer) {
    TechniquePasses passes(diligent(), pass_list, gbuffer, pass_list.params());
    passes.run("reprojected_depth");
    return passes.image("reprojected_depth");
}

Tracers::Images diligent_depth_hierarchies(PassList& pass_list, const GBuffer& gbuffer,
                                           const DiligentTracingParameters& parameters) {
    return TechniquePasses(diligent(), pass_list, gbuffer, parameters.params, {}, {}, &parameters.tracers)
        .list.pyramids();
}

DiligentMask diligent_mask(PassList& pass_list, const GBuffer& gbuffer, const DiligentTracingParameters& tracing,
                           const DiligentFilterParameters&) {
    TechniquePasses passes(diligent(), pass_list, gbuffer, tracing.params);
    passes.run("mask");
    const Image full = passes.image("mask");
    if (value_of(tracing.params, "half_resolution") != true) return {passes.image("roughness"), full, full};
    passes.run("half_resolution_mask");
    return {passes.image("roughness"), full, passes.image("half_resolution_mask")};
}

DiligentRays diligent_trace(PassList& pass_list, const GBuffer& gbuffer, const Tracers::Images& hierarchies,
                            const Image& noise, const Image& color, const DiligentMask& mask,
                            const DiligentTracingParameters& parameters, RayProbe* probe) {
    std::map<std::string, Image> images = images_of(mask);
    for (const char* name : {"noise_table", "white_noise", "blue_noise", "golden_noise_from_half"})
        images[name] = noise;
    images["hit_color"] = color;
    TechniquePasses passes(diligent(), pass_list, gbuffer, parameters.params, images, {}, &parameters.tracers, probe);
    passes.list.set_pyramids(hierarchies);
    passes.run("intersection");
    return {passes.image("ray_radiance"), passes.image("ray_direction")};
}

DiligentResolved diligent_reconstruct(PassList& pass_list, const GBuffer& gbuffer, const DiligentRays& rays,
                                      const DiligentMask& mask, const DiligentFilterParameters& parameters) {
    std::map<std::string, Image> images = images_of(mask);
    images["ray_radiance"] = rays.radiance, images["ray_direction"] = rays.direction;
    TechniquePasses passes(diligent(), pass_list, gbuffer, parameters.params, images);
    passes.run("spatial_reconstruction");
    return {passes.image("resolved_radiance"), passes.image("resolved_variance"), passes.image("hit_depth")};
}

void diligent_accumulate(PassList& pass_list, const GBuffer& gbuffer, const Image& reprojected_depth,
                         const DiligentResolved& resolved, const DiligentHistories& histories, const DiligentMask& mask,
                         const DiligentFilterParameters& parameters) {
    std::map<std::string, Image> images = images_of(mask);
    images["reprojected_depth"] = reprojected_depth;
    images["resolved_radiance"] = resolved.radiance, images["resolved_variance"] = resolved.variance;
    images["hit_depth"] = resolved.hit_depth;
    for (const PassList::History& history : {histories.radiance, histories.variance})
        images[history.current.name] = history.current, images[history.previous.name] = history.previous;
    TechniquePasses(diligent(), pass_list, gbuffer, parameters.params, images).run("temporal_accumulation");
}

Image diligent_cleanup(PassList& pass_list, const GBuffer& gbuffer, const Image& radiance, const Image& variance,
                       const DiligentMask& mask, const DiligentFilterParameters& parameters) {
    std::map<std::string, Image> images = images_of(mask);
    images["accumulated_radiance"] = radiance, images["accumulated_variance"] = variance;
    TechniquePasses passes(diligent(), pass_list, gbuffer, parameters.params, images);
    if (passes.list.known().by_name().at("is_guided") == true) {
        passes.run("guided_coefficients");
        passes.run("guided_cleanup");
    } else {
        passes.run("bilateral_cleanup");
    }
    return passes.image("reflections");
}

void draw_masked(PassList::Pass& pass, const Image& mask) {
    if (mask.format == Format::d16)
        pass.depth({.compare = DepthTest::Compare::less, .is_written = false, .image = mask});
    else
        pass.stencil({.mode = Stencil::Mode::keep_equal, .value = 255, .image = mask});
    pass.run();
}
