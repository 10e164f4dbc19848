// Where the rays are that a pixel reuses: at eight points of a disk around it, turned by a pattern of 4x4 pixels.
#ifndef DILIGENT_SSR_NEIGHBOR_RAYS_GLSL
#define DILIGENT_SSR_NEIGHBOR_RAYS_GLSL
#include "core/shared/brdf.h"

uniform sampler2D ray_radiance, ray_direction;

const int neighbor_count = 8;

// xy: points of a Poisson disk of radius 1 (DiligentFX); z: their distance from its centre.
const vec3 disk[neighbor_count] = vec3[neighbor_count](
    vec3(-0.4706069, -0.4427112, 0.6461146), vec3(-0.9057375, 0.3003471, 0.9542373),
    vec3(-0.3487388, 0.4037880, 0.5335386), vec3(0.1023042, 0.6439373, 0.6520134),
    vec3(0.5699277, 0.3513750, 0.6695386), vec3(0.2939128, -0.1131226, 0.3149309),
    vec3(0.7836658, -0.4208784, 0.8895339), vec3(0.1564120, -0.8198990, 0.8346850));

// Sixteenths of a turn, column by column of pixels (DiligentFX).
const int turns_of_pixel[16] = int[16](0, 12, 3, 15, 8, 4, 11, 7, 2, 14, 1, 13, 10, 6, 9, 5);

mat2 disk_rotation(ivec2 pixel) {
    int frame = rotate_kernel ? int(camera.frame.x & 15u) : 0;
    int turns = (turns_of_pixel[4 * (pixel.x & 3) + (pixel.y & 3)] + frame) & 15;
    float angle = 2.0 * pi * float(turns) / 16.0;
    return mat2(cos(angle), -sin(angle), sin(angle), cos(angle));
}

// Pixels. Mirrors have no disk: all eight points are the pixel itself.
float disk_radius(float perceptual_roughness) {
    float pixels_per_unit = half_resolution && scale_radius ? 2.0 : 1.0;
    return spatial_reconstruction_radius * clamp(5.0 * perceptual_roughness, 0.0, 1.0) * pixels_per_unit;
}

// Of the eight, for a disk of that radius.
int samples_of(float radius) {
    float share = radius / max(disk_radius(1.0), 1e-6);
    return variable_samples ? clamp(int(ceil(share * float(neighbor_count))), 1, neighbor_count) : neighbor_count;
}

ivec2 clamped_to_rays(ivec2 texel) { return clamp(texel, ivec2(0), textureSize(ray_radiance, 0) - 1); }

// The ray `offset` pixels away.
ivec2 neighbor_ray(ivec2 pixel, vec2 offset) {
    vec2 corner = vec2(pixel) + offset;
    if (!half_resolution) return clamped_to_rays(ivec2(corner + 0.5));
    return clamped_to_rays(ivec2(0.5 * corner + (nearest_half_rays ? 0.25 : 0.5)));
}

ivec2 own_ray_of(ivec2 pixel) { return clamped_to_rays(half_resolution ? pixel / 2 : pixel); }
#endif
