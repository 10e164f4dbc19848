// Directions of rays.
#ifndef FROSTBITE_SSSR_DRAW_RAY_GLSL
#define FROSTBITE_SSSR_DRAW_RAY_GLSL
#include "common/ggx_lobe.h"
#include "common/mirror_ray.glsl"
#include "frostbite_sssr/random.glsl"

// A surface with a specular term that is smooth enough and whose shading normal faces the viewer.
bool starts_rays(ivec2 pixel) {
    return reflects(pixel, max_roughness) && dot(view_direction(view_position(pixel)), view_normal(pixel)) < 0.0;
}

struct DrawnRay {
    vec3 direction;         // view space, unit
    float inverse_density;  // of the lobe, however often it was drawn
    bool is_above_horizon;  // of the shading normal
};

// Ray k of a pixel that starts rays, drawn again while it goes below the horizon.
DrawnRay draw_ray(ivec2 pixel, vec3 towards_surface, uint k, uint first_dimension) {
    mat3 view_from_local = basis_from_normal(view_normal(pixel));
    vec3 o = -towards_surface * view_from_local;
    float alpha = ggx_alpha(texelFetch(normal, pixel, 0).w);
    LobeSample drawn;
    for (uint draw = 0u;; ++draw) {
        drawn = sample_lobe(lobe, o, alpha, importance_bias, random_pair(pixel, k, first_dimension + draw));
        if (drawn.direction.z > 0.0 || draw == max_regenerations) break;
    }
    return DrawnRay(view_from_local * drawn.direction, drawn.inverse_density, drawn.direction.z > 0.0);
}
#endif
