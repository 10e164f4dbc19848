#pragma once
#include "core/gpu/image.h"

#include <vector>

class EnvironmentImages;

/// The first hit of every pixel, and the lit colour that SSR reads. World space, metres, linear radiance. All images
/// have one extent; shaders name each as its member here.
struct GBuffer {
    Image depth;  ///< r32f: device depth as the depth buffer of the chosen format held it; its clear value where
                  ///< nothing was hit
    Image geometric_normal;  ///< rgba32f: xyz unit, towards the camera
    Image normal;            ///< rgba32f: xyz unit shading normal, w perceptual roughness
    Image base_color;        ///< rgba32f: rgb, w metalness
    Image emission;          ///< rgba32f: rgb radiance, w specular factor (Material::specular; 0 for unlit and for the
                             ///< background)
    Image motion;            ///< rg32f: uv_now - uv_before, of camera and object, without jitter
    Image material_id;       ///< r32ui: index of the material + 1; 0: background
    Image previous_depth, previous_normal;  ///< of the frame before; in the first frame this frame's own
    Image lit;  ///< rgba32f: emission and diffusely reflected radiance towards the camera; environment where nothing
                ///< was hit. Compositor::add_environment() adds reflections
    Image fallback;  ///< rgba32f: the environment prefiltered over each pixel's specular lobe, for composite and
                     ///< techniques

    // The next layers of depth, without storage unless Technique::needs_depth_layers(); float32 for every depth format.
    Image second_depth;  ///< r32f: device depth of the next surface along each pixel's ray; the far plane's where there
                         ///< is none
    Image back_depth;    ///< r32f: `second_depth` where it shows the back of a surface, which ends the visible object;
                         ///< else `depth`: the visible object counts as a sheet

    Image lit_without_specular;  ///< `lit` without specular reflections, if `lit` holds them: composites add theirs to
                                 ///< it; else without storage

    Image dielectric_f0;  ///< rgba32f: rgb reflectance of dielectrics at normal incidence, which the specular factor
                          ///< scales; read by dielectric_f0_at() (core/shaders/gbuffer/dielectric_f0.glsl)
    bool has_dielectric_f0 =
        false;  ///< some material's reflectance is not 0.04 for all colours; else `dielectric_f0` is one pixel of 0.04

    const EnvironmentImages* environment = nullptr;  ///< for bind_environment(); none with a G-buffer from files

    std::vector<Image> images() const {
        std::vector<Image> all = {depth,       geometric_normal, normal,          base_color, emission, motion,
                                  material_id, previous_depth,   previous_normal, lit,        fallback};
        for (const Image& optional : {second_depth, back_depth, lit_without_specular, dielectric_f0})
            if (optional.storage) all.push_back(optional);
        return all;
    }
};
