#pragma once
#include "core/gbuffer/composite.h"
#include "experiments/study/config/config.h"
#include "variants/variant.h"

/// One frame of a variant with images of its own, measured or timed: the camera is that of the G-buffer, but for the
/// seed, so that histories go on from the frame before. A pass outside the variant's limits is an Error.
Reflections render_variant(PassGraph& graph, Variant& variant, CameraData camera, unsigned seed,
                           const GBuffer& gbuffer);

/// A technique with images and histories of its own, and what composites its results.
struct Renderer {
    std::unique_ptr<Variant> variant;
    std::unique_ptr<RayProbe> probe;  ///< of the variant
    std::unique_ptr<PassGraph> graph;
    std::unique_ptr<Compositor> compositor;

    Renderer(Device& device, glm::uvec2 extent, const VariantConfig& point,
             CompositeFormula formula = CompositeFormula::split_sum);

    /// As render_variant().
    Reflections render(const CameraData& camera, unsigned seed, const GBuffer& gbuffer) const {
        return render_variant(*graph, *variant, camera, seed, gbuffer);
    }
};
