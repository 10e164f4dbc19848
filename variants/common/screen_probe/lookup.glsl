// Reads the screen probe for rays that found nothing.
#ifndef SCREEN_PROBE_LOOKUP_GLSL
#define SCREEN_PROBE_LOOKUP_GLSL
#include "common/screen_probe/octahedral_map.glsl"

uniform sampler2D screen_probe, screen_probe_nearness;

// Place of a direction (world space) in the probe's images: texels, after the border.
vec2 probe_texel(vec3 direction) { return (0.5 * octahedral_place(direction) + 0.5) * float(probe_width) + 1.0; }

// Of a ray from a point, from the camera on (m), in a unit direction, all in world space: a share of it that meets a
// surface, rgb that times the surface's radiance. It is looked for where the ray meets a sphere about the camera that is
// as large as things are far away there, in steps (Szirmay-Kalos et al. 2005, "Approximate Ray-Tracing on the GPU with
// Distance Impostors").
vec4 surfaces_along(vec3 from_camera, vec3 direction) {
    const int steps = 2;
    const float farthest = 1e6;  // m
    vec3 towards = direction;
    for (int i = 0; i < steps; ++i) {
        float nearness = texelFetch(screen_probe_nearness, ivec2(probe_texel(towards)), 0).r;
        float radius = max(1.0 / max(nearness, 1.0 / farthest), 1.01 * length(from_camera));
        float b = dot(from_camera, direction), c = dot(from_camera, from_camera) - radius * radius;
        towards = normalize(from_camera + direction * (sqrt(max(b * b - c, 0.0)) - b));
    }
    return textureLod(screen_probe, probe_texel(towards) / float(probe_width + 2), 0.0);
}
#endif
