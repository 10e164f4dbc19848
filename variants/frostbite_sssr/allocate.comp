// Lists the rays of every traced pixel for the tracer of its roughness. The order of the lists changes from run to run,
// but each ray writes to its own place, so results do not.
#include "frostbite_sssr/counters.glsl"
#include "frostbite_sssr/draw_ray.glsl"
#include "denoisers/ray.glsl"
#include "frostbite_sssr/tile.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
uniform sampler2D ray_count;
buffer smooth_list { uint smooth_ray[]; };
buffer rough_list { uint rough_ray[]; };

uint rays_of(ivec2 pixel) {
    return starts_rays(pixel) ? uint(texelFetch(ray_count, pixel / tile_width, 0).r) : 0u;
}

// One addition to the counters of all groups per group.
shared uint group_counts[2], group_first[2];

void main() {
    ivec2 traced = ivec2(gl_GlobalInvocationID.xy);
    if (gl_LocalInvocationIndex < 2u) group_counts[gl_LocalInvocationIndex] = 0u;
    barrier();

    bool is_traced = all(lessThan(traced, traced_extent()));
    ivec2 pixel = traced_pixel(is_traced ? traced : ivec2(0), camera.frame.x);
    uint count = is_traced ? rays_of(pixel) : 0u;
    uint tracer = texelFetch(normal, pixel, 0).w >= rough_from ? 1u : 0u;
    uint first = count > 0u ? atomicAdd(group_counts[tracer], count) : 0u;
    barrier();

    if (gl_LocalInvocationIndex == 0u) {
        group_first[0] = atomicAdd(smooth_count, group_counts[0]);
        group_first[1] = atomicAdd(rough_count, group_counts[1]);
    }
    barrier();

    for (uint k = 0u; k < count; ++k) {
        uint place = group_first[tracer] + first + k, index = index_of_ray(traced, k);
        if (tracer == 0u)
            smooth_ray[place] = index;
        else
            rough_ray[place] = index;
    }
}
