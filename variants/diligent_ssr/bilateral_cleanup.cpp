#include "variants/diligent_ssr/targets.h"

Image diligent_cleanup(PassGraph& graph, const GBuffer& gbuffer, const Image& radiance, const Image& variance,
                       const DiligentMask& mask, const DiligentFilterParameters& parameters) {
    const Format format = parameters.float_histories ? Format::rgba32f : Format::rgba16f;
    const Image reflections = diligent_target(graph, "reflections", format, mask.full.extent, true);
    const auto draw = [&](const char* shader) {
        auto pass = graph.fragment(shader);
        pass.read(gbuffer.depth)
            .read(mask.roughness)
            .read(radiance.as("accumulated_radiance"))
            .read(variance.as("accumulated_variance"));
        return pass;
    };
    if (parameters.bilateral_cleanup && parameters.cleanup.is("guided")) {
        const auto target = [&](const char* name) {
            return diligent_target(graph, name, Format::rgba32f, mask.full.extent, true);
        };
        const Image slope = target("guided_slope"), offset = target("guided_offset");
        auto fit = draw("diligent_ssr/guided_coefficients.frag");
        fit.write(slope).write(offset);
        draw_masked(fit, mask.full);
        auto apply = draw("diligent_ssr/guided_cleanup.frag");
        apply.read(slope).read(offset).write(reflections);
        draw_masked(apply, mask.full);
        return reflections;
    }
    auto pass = draw("diligent_ssr/bilateral_cleanup.frag");
    pass.read(gbuffer.normal).write(reflections);
    draw_masked(pass, mask.full);
    return reflections;
}
