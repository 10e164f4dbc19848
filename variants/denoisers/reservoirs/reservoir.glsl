// A ray that stands for those that its pixel had.
#ifndef RESERVOIRS_RESERVOIR_GLSL
#define RESERVOIRS_RESERVOIR_GLSL
#include "common/ggx_lobe.h"
#include "common/luminance.glsl"
#include "common/mirror_ray.glsl"
#include "frostbite_sssr/random.glsl"

// Of a pixel. View space; o: towards the viewer, local.
struct Lobe {
    mat3 view_from_local;
    vec3 o;
    float alpha;
};

Lobe lobe_at(ivec2 pixel) {
    mat3 view_from_local = basis_from_normal(view_normal(pixel));
    vec3 o = -view_direction(view_position(pixel)) * view_from_local;
    return Lobe(view_from_local, o, ggx_alpha(texelFetch(normal, pixel, 0).w));
}

// sr^-1, of all of the lobe, with what is below the horizon.
float density_of(Lobe lobe_of_pixel, vec3 vs_direction) {
    return lobe_density(lobe, lobe_of_pixel.o, vs_direction * lobe_of_pixel.view_from_local, lobe_of_pixel.alpha);
}

// World space. Empty with a weight of 0.
struct Reservoir {
    vec3 radiance;
    float density;  // of the ray in the lobe that it was drawn from (sr^-1), at most max_density
    vec3 hit;
    float weight;   // by which to multiply what it sees to integrate over the lobe: the inverse of a density (sr)
    vec3 origin;    // of the ray, which may be that of another pixel
    float count;    // of rays that it stands for
};

const Reservoir empty_reservoir = Reservoir(vec3(0.0), 0.0, vec3(0.0), 0.0, vec3(0.0), 0.0);

Reservoir unpacked_reservoir(vec4 radiance, vec4 hit, vec4 origin) {
    return Reservoir(radiance.rgb, radiance.a, hit.xyz, hit.w, origin.xyz, origin.w);
}
#endif
