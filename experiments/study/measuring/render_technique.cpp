#include "experiments/study/measuring/render_technique.h"

#include "variants/registry.h"

Reflections render_technique(PassList& pass_list, Technique& technique, CameraData camera, unsigned seed,
                             const GBuffer& gbuffer) {
    camera.frame.y = seed;
    pass_list.begin_frame(camera, technique.params, gbuffer.images());
    // Rays are recorded in storage buffers, which is no part of the technique.
    const bool is_recording = technique.ray_probe && technique.ray_probe->is_recording;
    if (is_recording) technique.ray_probe->recorded.clear();
    const LimitScope limits(pass_list, is_recording ? Limits::none : technique.limits);
    return technique.render(pass_list, gbuffer);
}

Renderer::Renderer(Device& device, glm::uvec2 extent, const PointConfig& point, CompositeFormula formula)
    : technique(make_technique(point.technique, point.parameters, point.preset)),
      probe(std::make_unique<RayProbe>()),
      pass_list(std::make_unique<PassList>(device, extent)),
      compositor(std::make_unique<Compositor>(*pass_list, formula)) {
    technique->ray_probe = probe.get();
}
