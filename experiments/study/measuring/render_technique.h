#pragma once
#include "core/gbuffer/composite.h"
#include "experiments/study/config/config.h"
#include "variants/common/technique.h"

/// One frame of a technique with images of its own, measured or timed: the camera is that of the G-buffer, but for the
/// seed, so that histories go on from the frame before. A pass outside the technique's limits is an Error.
Reflections render_technique(PassList& pass_list, Technique& technique, CameraData camera, unsigned seed,
                             const GBuffer& gbuffer);

/// A technique with images and histories of its own, and what composites its results.
struct Renderer {
    std::unique_ptr<Technique> technique;
    std::unique_ptr<RayProbe> probe;  ///< of the technique
    std::unique_ptr<PassList> pass_list;
    std::unique_ptr<Compositor> compositor;

    Renderer(Device& device, glm::uvec2 extent, const PointConfig& point,
             CompositeFormula formula = CompositeFormula::split_sum);

    /// As render_technique().
    Reflections render(const CameraData& camera, unsigned seed, const GBuffer& gbuffer) const {
        return render_technique(*pass_list, *technique, camera, seed, gbuffer);
    }
};
