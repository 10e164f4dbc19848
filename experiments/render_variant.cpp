#include "experiments/render_variant.h"

Reflections render_variant(PassGraph& graph, Variant& variant, CameraData camera, unsigned seed,
                           const GBuffer& gbuffer) {
    camera.frame.y = seed;
    graph.begin_frame(camera, variant.params, gbuffer.images());
    const LimitScope limits(graph, variant.limits);
    return variant.render(graph, gbuffer);
}
