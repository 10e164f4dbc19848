#pragma once
#include "core/scene/camera.h"
#include "core/scene/scene.h"
#include "groundtruth/reference/reference.h"

/// What the surfaces that pixels show do with the light that falls on them. All of one extent.
struct LitSurfaces {
    HostImage albedo;    ///< RGB, of the diffuse reflection; 0 where there is none, or nothing was hit
    HostImage emitted;   ///< RGB, W sr^-1 m^-2
    HostImage normal;    ///< XYZ, unit shading normal, world space
    HostImage position;  ///< XYZ, m, world space
    HostImage distance;  ///< one channel: from the camera, m
};

/// Of the first hits of a frame's pixels. Fails with MachineError if Embree runs out of memory.
LitSurfaces lit_surfaces(const Scene& scene, const ScenePose& pose, const CameraPose& camera, glm::uvec2 extent);

/// The lit colour as an engine has it: without the noise of a path tracer, at the price of details of its light that
/// are smaller than a few pixels.
struct FilteredLit {
    HostImage mean;  ///< RGB: (half_a + half_b) / 2
    /// RGB, each of the samples of its half, with weights of the other: what both share of noise is not in their
    /// difference, which is a lower bound of what is left.
    HostImage half_a, half_b;
};

/// Non-local means of the light that falls on the surfaces (lit less emitted, over albedo), over 15 x 15 pixels with
/// patches of 5 x 5. Weights of each half's pixels come from the other half, so that no noise chooses itself, from the
/// variance of both, and from the surfaces' normals and planes. Pixels without albedo stay as they are, and so does
/// light without noise. Source: Rousselle, Knaus, Zwicker, "Adaptive Rendering with Non-Local Means Filtering" (2012),
/// sections 4 and 5 (k = 0.45, alpha = 1); Rousselle, Manzi, Zwicker, "Robust Denoising using Feature and Color
/// Information" (2013) for the other half's weights and for features.
FilteredLit filter_lit(const ReferenceOutput& lit, const LitSurfaces& surfaces);
