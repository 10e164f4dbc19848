// Moments of the 9x9 pixels in shared memory around one.
#ifndef AMD_SSSR_DENOISER_NEIGHBORHOOD_GLSL
#define AMD_SSSR_DENOISER_NEIGHBORHOOD_GLSL
#include "amd_sssr/denoiser_shared_halves.glsl"

// `at`: of the pixel in shared memory.
Neighborhood neighborhood_at(ivec2 at) {
    Moments sum = no_moments;
    for (int y = -reach; y <= reach; ++y)
        for (int x = -reach; x <= reach; ++x)
            add_neighbor(shared_color_at(at + ivec2(x, y)), kernel_weight(x) * kernel_weight(y), sum);
    return neighborhood_of(sum);
}
#endif
