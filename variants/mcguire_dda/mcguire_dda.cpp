#include "variants/mcguire_dda/mcguire_dda.h"

Reflections McGuireDda::render_passes(PassGraph& graph, const GBuffer& gbuffer) {
    const Image hit = graph.image("hit", Format::rgba32f);
    const Image radiance = graph.image("radiance", Format::rgba32f);
    const Image confidence = graph.image("confidence", Format::r8);
    if (is_left_out_) {
        for (const Image& image : {hit, radiance, confidence}) graph.clear(image, {});
        return {radiance, confidence};
    }
    tracers.run(graph, graph.compute("mcguire_dda/trace.comp").write(hit), {"tracer"},
                tracers.images(graph, gbuffer.depth), ray_probe);
    graph.compute("mcguire_dda/shade.comp")
        .read(hit)
        .read(gbuffer.lit, {.is_linear = bilinear_color})
        .write(radiance)
        .write(confidence)
        .run();
    return {radiance, confidence};
}

std::vector<LeftOut> McGuireDda::leave_out_passes(const SceneFacts& facts) {
    is_left_out_ = !facts.has_reflective || facts.min_roughness > max_roughness;
    if (!is_left_out_) return {};
    const std::string fact =
        facts.has_reflective ? "no reflective surface as smooth as max_roughness" : "nothing reflective";
    return {{"mcguire_dda/trace", fact, "no pixel would start a ray"}, {"mcguire_dda/shade", fact, "no ray would hit"}};
}
