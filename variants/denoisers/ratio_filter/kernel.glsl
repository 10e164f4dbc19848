// How wide filters are, and random places in them.
#ifndef RATIO_FILTER_KERNEL_GLSL
#define RATIO_FILTER_KERNEL_GLSL
#include "core/shared/brdf.h"
#include "frostbite_sssr/random.glsl"

// Beside those of rays.
const uint upsampling_dimension = tap_dimension, spatial_dimension = tap_dimension + 1u,
           bilateral_dimension = tap_dimension + 2u;

// Share of the widest filter that a roughness asks for.
float width_share(float roughness) { return clamp(roughness / full_roughness, 0.0, 1.0); }

// Point i of n of Hammersley's set.
vec2 hammersley(uint i, uint n) { return vec2(float(i) / float(n), radical_inverse(i, 2u)); }

// Of a square of that width, moved by a random vector and wrapped.
ivec2 box_offset(uint i, uint n, vec2 random, float width) {
    return ivec2(floor((fract(hammersley(i, n) + random) - 0.5) * width + 0.5));
}

#endif
