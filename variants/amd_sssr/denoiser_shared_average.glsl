// Averages of the eight tiles of a group: summed by fours in halves, as the original does, so that they round alike.
// With float_histories they are summed in floats.
#ifndef AMD_SSSR_DENOISER_SHARED_AVERAGE_GLSL
#define AMD_SSSR_DENOISER_SHARED_AVERAGE_GLSL
#include "amd_sssr/denoiser_history_output.glsl"

shared vec4 shared_average[8][8][8];  // tile, row, column; rgb times weight, weight

void share_at(ivec2 at, vec4 weighted) {
    shared_average[gl_LocalInvocationID.y][at.y][at.x] =
        float_histories ? weighted : unpacked_halves(packed_halves(weighted));
}
vec4 shared_at(ivec2 at) { return shared_average[gl_LocalInvocationID.y][at.y][at.x]; }

void share_for_average(int row, vec4 weighted) { share_at(ivec2(gl_LocalInvocationID.x, row), weighted); }

void average_tile(ivec2 first) {
    int lane = int(gl_LocalInvocationID.x);
    for (int size = 2; size <= 8; size *= 2) {
        barrier();
        int sums = 8 / size, i = lane;
        do {
            ivec2 near = ivec2(i % sums, i / sums) * size, far = near + size / 2;
            if (i < sums * sums)
                share_at(near, shared_at(near) + shared_at(ivec2(far.x, near.y)) + shared_at(ivec2(near.x, far.y)) +
                                   shared_at(far));
            i += 8;
        } while (i < sums * sums);
    }
    if (lane == 0 && is_on_screen(first)) store_average(first / 8, shared_at(ivec2(0)));
}
#endif
