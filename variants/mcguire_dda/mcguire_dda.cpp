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

TracingVariant::Needless McGuireDda::find_needless(const SceneFacts& facts) {
    Needless needless{.such_a_surface = "as smooth as max_roughness",
                      .stages = {"mcguire_dda/trace", "mcguire_dda/shade"}};
    needless.rays = is_left_out_ = !facts.has_reflective || facts.min_roughness > max_roughness;
    if (tracers.needs_pyramid()) needless.stages.insert(needless.stages.begin(), "common/depth_pyramid");
    return needless;
}
