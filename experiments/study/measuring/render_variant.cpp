#include "experiments/study/measuring/render_variant.h"

#include "variants/registry.h"

Reflections render_variant(PassGraph& graph, Variant& variant, CameraData camera, unsigned seed,
                           const GBuffer& gbuffer) {
    camera.frame.y = seed;
    graph.begin_frame(camera, variant.params, gbuffer.images());
    // Rays are recorded in storage buffers, which is no part of the technique.
    const bool is_recording = variant.ray_probe && variant.ray_probe->is_recording;
    if (is_recording) variant.ray_probe->recorded.clear();
    const LimitScope limits(graph, is_recording ? Limits::none : variant.limits);
    return variant.render(graph, gbuffer);
}

Renderer::Renderer(Device& device, glm::uvec2 extent, const VariantConfig& point, CompositeFormula formula)
    : variant(make_variant(point.variant, point.parameters, point.preset)),
      probe(std::make_unique<RayProbe>()),
      graph(std::make_unique<PassGraph>(device, extent)),
      compositor(std::make_unique<Compositor>(*graph, formula)) {
    variant->ray_probe = probe.get();
}
