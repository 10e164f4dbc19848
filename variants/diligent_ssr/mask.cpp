#include "variants/diligent_ssr/targets.h"

#include <cmath>

namespace {

Image cleared_mask(PassGraph& graph, const std::string& name, const DiligentTracingParameters& parameters,
                   unsigned divisor) {
    const Image mask = graph.image(name, parameters.mask.is("stencil") ? Format::d32f_s8 : Format::d16, 1, divisor);
    graph.clear(mask, {});
    return mask;
}

Image roughness_target(PassGraph& graph, bool is_float, bool is_cleared) {
    const Image roughness =
        graph.image_black_at_first("roughness", is_float ? Format::r32f : Format::r8, graph.extent());
    if (is_cleared) graph.clear(roughness, glm::vec4(1.0f));  // what is left out counts as rough
    return roughness;
}

}  // namespace

DiligentMask diligent_mask(PassGraph& graph, const GBuffer& gbuffer, const DiligentTracingParameters& tracing,
                           const DiligentFilterParameters& filter) {
    const Image roughness = roughness_target(graph, tracing.float_roughness, filter.clear_targets);
    const Image full = cleared_mask(graph, "mask", tracing, 1);
    auto pass = graph.fragment("diligent_ssr/mask.frag");
    pass.read(gbuffer.depth).read(gbuffer.normal).read(gbuffer.base_color).read(gbuffer.emission).write(roughness);
    draw_mask(pass, full);
    if (!tracing.half_resolution) return {roughness, full, full};

    const Image half = cleared_mask(graph, "half_resolution_mask", tracing, 2);
    auto half_pass = graph.fragment("diligent_ssr/half_resolution_mask.frag");
    half_pass.read(gbuffer.depth).read(roughness);
    draw_mask(half_pass, half);
    return {roughness, full, half};
}

float diligent_roughness_of_8_bits(float perceptual) {
    return std::floor(perceptual * 255.0f + 0.5f) * (1.0f / 255.0f);  // as mask.frag
}
