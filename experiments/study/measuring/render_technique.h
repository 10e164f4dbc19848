#pragma once
#include "core/gbuffer/composite.h"
#include "experiments/study/config/config.h"
#include "variants/common/technique.h"

/// Renders one frame of a technique that has its own images. The camera is the G-buffer's except for the seed, so that
/// histories continue from the previous frame. Fails with Error if a pass exceeds the technique's limits.
Reflections render_technique(PassList& pass_list, Technique& technique, CameraData camera, unsigned seed,
                             const GBuffer& gbuffer);

/// A technique with its own images and histories, and a compositor of its results.
struct Renderer {
    std::unique_ptr<Technique> technique;
    std::unique_ptr<RayProbe> probe;  ///< of the technique
    std::unique_ptr<PassList> pass_list;
    std::unique_ptr<Compositor> compositor;

    Renderer(Device& device, glm::uvec2 extent, const PointConfig& point,
             CompositeFormula formula = CompositeFormula::split_sum);

    /// See render_technique().
    Reflections render(const CameraData& camera, unsigned seed, const GBuffer& gbuffer) const {
        return render_technique(*pass_list, *technique, camera, seed, gbuffer);
    }
};
