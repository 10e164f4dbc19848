#pragma once
#include "core/gpu/image.h"

#include <vector>

class EnvironmentImages;

/// The first hit of every pixel, and the lit colour which SSR reads. World space, metres, linear radiance. Images of one
/// extent; each is bound in shaders by its member's name.
struct GBuffer {
    Image depth;             ///< r32f: device depth as the depth buffer of the chosen format held it; its clear value where nothing was hit
    Image geometric_normal;  ///< rgba32f: xyz unit, towards the camera
    Image normal;            ///< rgba32f: xyz unit shading normal, w perceptual roughness
    Image base_color;        ///< rgba32f: rgb, w metalness
    Image emission;          ///< rgba32f: rgb radiance, w specular factor (Material::specular; 0 for unlit and for the background)
    Image motion;            ///< rg32f: uv_now - uv_before, of camera and object, without jitter
    Image material_id;       ///< r32ui: index of the material + 1; 0: background
    Image previous_depth, previous_normal;  ///< of the frame before; in the first frame this frame's own
    Image lit;               ///< rgba32f: emission and diffusely reflected radiance towards the camera; environment where nothing was hit
    Image fallback;          ///< rgba32f: the environment prefiltered over each pixel's specular lobe, for composite and variants

    const EnvironmentImages* environment = nullptr;  ///< for bind_environment(); none with a G-buffer from files

    std::vector<Image> images() const {
        return {depth, geometric_normal, normal, base_color, emission, motion, material_id, previous_depth, previous_normal, lit, fallback};
    }
};
