// The surface values that make a pixel's lobe.
#ifndef FROSTBITE_SSSR_SURFACE_GLSL
#define FROSTBITE_SSSR_SURFACE_GLSL
#include "common/ggx_lobe.h"
#include "common/mirror_ray.glsl"
#include "core/shaders/gbuffer/dielectric_f0.glsl"
#include "core/shaders/gbuffer/split_sum.glsl"

struct Surface {
    vec3 position;          // view space
    vec3 geometric_normal;  // view space
    mat3 view_from_local;   // local frame of core/shared/brdf.h
    vec3 o;                 // towards the viewer, local
    float roughness, alpha;
    vec3 f0;
    float f90;
};

Surface surface_of(ivec2 pixel) {
    vec4 color_metalness = texelFetch(base_color, pixel, 0);
    float specular = texelFetch(emission, pixel, 0).w;
    Surface surface;
    surface.position = view_position(pixel);
    surface.view_from_local = basis_from_normal(view_normal(pixel));
    surface.geometric_normal = view_geometric_normal(pixel);
    surface.o = -view_direction(surface.position) * surface.view_from_local;
    surface.roughness = texelFetch(normal, pixel, 0).w;
    surface.alpha = ggx_alpha(surface.roughness);
    surface.f0 = specular_f0(color_metalness.rgb, color_metalness.w, specular, dielectric_f0_at(pixel));
    surface.f90 = specular_f90(color_metalness.w, specular);
    return surface;
}

// The integral of the BRDF times the cosine.
vec3 reflectance(Surface surface) {
    vec2 ab = split_sum_factors(surface.o.z, surface.roughness);
    return surface.f0 * ab.x + surface.f90 * ab.y;
}

// The BRDF times the cosine, for a local direction.
vec3 reflectance_density(Surface surface, vec3 i) {
    if (i.z <= 0.0) return vec3(0.0);
    float fresnel = schlick_weight(dot(surface.o, normalize(surface.o + i)));
    return mix(surface.f0, vec3(surface.f90), fresnel) * ggx_specular(surface.o, i, surface.alpha) * i.z;
}
#endif
