// The data of each ray: TracedRays of denoiser.h. Needs the `camera` block, and the parameters of ray_draw.json.
#ifndef DENOISERS_RAY_GLSL
#define DENOISERS_RAY_GLSL
#include "denoisers/traced_pixel.glsl"

buffer directions { vec4 direction_of_ray[]; };
buffer hits { uvec4 hit_of_ray[]; };

// In place of the hit pixel. A ray that meets nothing on the screen; one whose every draw went below the horizon of the
// shading normal, and which nothing can meet: only estimator b counts those; one above that horizon, but into the
// geometric surface that it starts from: it was not marched, and tells something to those only whose surface it goes
// into, too.
const uint ray_missed = 0xffffffffu, ray_below_horizon = 0xfffffffeu, ray_into_surface = 0xfffffffdu;

// Of rays that hit, miss or go below the horizon alike, `direction` and its density are those of the last draw.
struct TracedRay {
    vec3 direction;         // view space, unit
    float inverse_density;  // with which it comes about (sr); 0: there is no such ray
    uint target;            // packed_pixel() of the hit, or a marker from above
    float ray_length;       // from the surface to the hit (m)
    float confidence;       // of a hit, [0, 1]
};

ivec2 pixel_of_target(uint target) { return ivec2(target & 0xffffu, target >> 16); }
bool is_hit(TracedRay ray) { return ray.target < ray_into_surface; }

ivec2 traced_of_pixel(ivec2 pixel) { return half_resolution ? pixel >> 1 : pixel; }

// `k` below max_rays.
uint index_of_ray(ivec2 traced, uint k) { return uint(traced.y * traced_extent().x + traced.x) * max_rays + k; }
ivec2 traced_of_ray(uint index) {
    int traced = int(index / max_rays), width = traced_extent().x;
    return ivec2(traced % width, traced / width);
}

void store_ray(uint index, TracedRay ray) {
    direction_of_ray[index] = vec4(ray.direction, ray.inverse_density);
    hit_of_ray[index] = uvec4(ray.target, floatBitsToUint(ray.ray_length), floatBitsToUint(ray.confidence), 0u);
}

TracedRay load_ray(uint index) {
    vec4 direction = direction_of_ray[index];
    uvec4 hit = hit_of_ray[index];
    return TracedRay(direction.xyz, direction.w, hit.x, uintBitsToFloat(hit.y), uintBitsToFloat(hit.z));
}
#endif
