// Random numbers of rays, probes and taps.
#ifndef FROSTBITE_SSSR_RANDOM_GLSL
#define FROSTBITE_SSSR_RANDOM_GLSL
#include "common/halton.h"
#include "denoisers/traced_pixel.glsl"

// Dimensions of a ray's random numbers: its draws, of which there are at most 17, and the start of its march. Those of
// probes follow, which are as many.
const uint ray_dimension = 0u, march_dimension = 17u, probe_dimension = 18u, tap_dimension = 36u;

// Number pair `dimension` of ray k, in [0, 1)^2. The first draws of a pixel's rays follow Halton's sequence from turn
// to turn, each k its own rotation of it: rays of one frame differ, and ray 0 alone covers the lobe, however many rays
// its tile gets and in which frames. All other pairs are independent: rotations of the same sequence would tie a
// redrawn ray to the one that it replaces, and the march to the direction. So are the draws of probes, whose places
// follow the digits of the frame as Halton's points do.
vec2 random_pair(ivec2 pixel, uint k, uint dimension) {
    uint place = packed_pixel(pixel), seed = camera.frame.y;
    if (dimension == ray_dimension) return rotated_halton(turn_of_pixel(pixel), k, uvec4(place, seed, 0u, 0u));
    return random_point(uvec4(place, seed, camera.frame.x, k | dimension << 2));  // k < 4
}
#endif
