// Whether a place of the previous frame showed the same surface.
#ifndef DENOISERS_SAME_REFLECTOR_GLSL
#define DENOISERS_SAME_REFLECTOR_GLSL
#include "frostbite_sssr/previous_view.glsl"

uniform sampler2D previous_normal;

// As the previous camera would see it: positions and the geometric normal in its view space, the shading normal in
// world space.
struct Reflector {
    vec3 position, geometric_normal, ws_normal;
    float roughness;
};

Reflector reflector_at(ivec2 pixel) {
    vec4 normal_roughness = texelFetch(normal, pixel, 0);
    return Reflector((camera.previous_view_from_world * world_position(pixel)).xyz, geometric_normal_before(pixel),
                     normal_roughness.xyz, normal_roughness.w);
}

// Whether the texel showed the same plane as rough as now; one that moved has its mirror image elsewhere. The limits
// are ours: 26 degrees, a tenth in perceptual roughness.
bool is_same_reflector(Reflector now, ivec2 texel) {
    vec4 before = texelFetch(previous_normal, texel, 0);
    return showed_plane(texel, now.position, now.geometric_normal) && dot(before.xyz, now.ws_normal) >= 0.9 &&
           abs(before.w - now.roughness) <= 0.1;
}
#endif
