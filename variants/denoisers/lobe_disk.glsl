// Taps on a disk that faces a lobe.
#ifndef DENOISERS_LOBE_DISK_GLSL
#define DENOISERS_LOBE_DISK_GLSL
#include "common/halton.h"
#include "core/shared/brdf.h"

const float golden_angle = 2.399827721492203;  // three.js; 1e-4 less than the golden angle is

// Unit axes of the disk on which a mirror shows what is seen along `axis`; the first across the plane of both.
mat2x3 disk_towards(vec3 axis, vec3 surface_normal) {
    vec3 seen = reflect(-axis, surface_normal), across = cross(surface_normal, seen);
    if (dot(across, across) < 1e-6) {
        mat3 basis = basis_from_normal(surface_normal);
        return mat2x3(basis[0], basis[1]);
    }
    vec3 tangent = normalize(across);
    return mat2x3(tangent, cross(seen, tangent));
}

// Low-discrepancy over pixels, which moves from frame to frame (Roberts 2018); radians.
float rotation_of(ivec2 pixel) {
    const vec2 steps = vec2(0.7548776662, 0.5698402910);
    uint index = camera.frame.x + pcg4d(uvec4(camera.frame.y, 0u, 0u, 0u)).x % 1024u;
    vec2 shifted = mod(vec2(pixel) + floor(32.0 * fract(float(index) * steps)), 32.0);
    return 2.0 * pi * fract(dot(shifted, steps));
}
#endif
