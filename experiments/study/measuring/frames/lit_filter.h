#pragma once
#include "core/scene/camera.h"
#include "core/scene/scene.h"
#include "groundtruth/reference/reference.h"

/// How the surfaces in each pixel reflect the light that falls on them. All images have one extent.
struct LitSurfaces {
    HostImage albedo;    ///< RGB, diffuse; 0 where there is none, or nothing was hit
    HostImage emitted;   ///< RGB, W sr^-1 m^-2
    HostImage normal;    ///< XYZ, unit shading normal, world space
    HostImage position;  ///< XYZ, m, world space
    HostImage distance;  ///< one channel: from the camera, m
};

/// Surfaces at the first hits of a frame's pixels. Fails with MachineError if Embree runs out of memory.
LitSurfaces lit_surfaces(const Scene& scene, const ScenePose& pose, const CameraPose& camera, glm::uvec2 extent);

/// The lit colour as an engine has it: without a path tracer's noise, and without details of light below a few pixels.
struct FilteredLit {
    HostImage mean;  ///< RGB: (half_a + half_b) / 2
    /// RGB: each filters the samples of its own half with weights from the other half. Their difference does not show
    /// the noise that both share: it is a lower bound of the remaining noise.
    HostImage half_a, half_b;
};

/// Non-local means of the light that falls on surfaces, (lit - emitted) / albedo, over 15 x 15 pixels with patches of 5
/// x 5. Weights of one half's pixels come from the other half, so that no noise chooses itself. They use the variance
/// of both halves, and the surfaces' normals and planes. Pixels without albedo and light without noise stay unchanged.
///
/// Sources: Rousselle, Knaus, Zwicker, "Adaptive Rendering with Non-Local Means Filtering" (2012), sections 4 and 5 (k
/// = 0.45, alpha = 1); Rousselle, Manzi, Zwicker, "Robust Denoising using Feature and Color Information" (2013) for
/// weights from the other half and for features.
FilteredLit filter_lit(const ReferenceOutput& lit, const LitSurfaces& surfaces);
