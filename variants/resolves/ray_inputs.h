#pragma once
#include "variants/resolves/resolves.h"
#include "variants/tracers/tracing_variant.h"

/// What stands before the march of a technique with a resolve: the parameters that resolves must know, and of each
/// frame the buffers that its rays are written to, and what they are drawn and shown by. Defined in ray_inputs/, so
/// that techniques which use other headers of this folder do not depend on those of Frostbite that it runs.
class RayInputs {
public:
    /// Declares those of ray_draw.h, `draw_directions`, `misses` and `previous_frame`.
    explicit RayInputs(ParameterSet& params);
    ~RayInputs();

    /// One for each traced pixel (resolves/traced_pixel.glsl).
    glm::uvec2 traced_extent(glm::uvec2 screen) const;
    unsigned max_rays() const;
    /// Makes them, and what the parameters ask for.
    ResolvedRays make(PassGraph& graph, const GBuffer& gbuffer);
    /// The picture of the rays, after the pass that wrote them.
    Reflections show(PassGraph& graph, const GBuffer& gbuffer, const ResolvedRays& rays, Resolves& resolves) const;

    bool depends_on_seed(Resolves& resolves) const;  ///< march aside
    std::string not_repeatable(const Tracers& tracers, Resolves& resolves) const;
    /// Completes `needless`, which holds the stages and readers of the technique's own passes, by what the parameters,
    /// the probe and the resolve need of the scene.
    void add_needless(TracingVariant::Needless& needless, const SceneFacts& facts, Resolves& resolves) const;

private:
    struct Parts;
    std::unique_ptr<Parts> parts_;
};
