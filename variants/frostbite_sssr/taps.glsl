// Which pixels an invocation resolves, and whose rays they share.
#ifndef FROSTBITE_SSSR_TAPS_GLSL
#define FROSTBITE_SSSR_TAPS_GLSL
#include "core/shared/brdf.h"
#include "frostbite_sssr/random.glsl"
#include "denoisers/ray.glsl"

// The choices of `taps` and `pattern`.
const int tap_count = taps == 0u ? 1 : taps == 1u ? 4 : 16;
const int max_tap_count = 16;
const bool is_shared = taps != 0u && pattern != 0u, is_interleaved = is_shared && pattern == 2u;

const int group_size = is_shared ? 4 : 1;
const int max_group_size = 4;

// The group's pixels, all or some of which may lie beyond the border. Those of `interleaved` are two pixels apart; the
// four groups of a 4x4 block move by half a block each in its own direction, another one every frame, so that next to
// each other are pixels that resolve different rays.
ivec2 first_pixel_of(ivec2 group) {
    if (!is_shared) return group;
    if (!is_interleaved) return 2 * group;
    ivec2 phase = group & 1;
    int turn = phase.x + 2 * phase.y + int(camera.frame.x & 3u);
    return 4 * (group >> 1) + phase - 2 * (ivec2(turn, turn >> 1) & 1);
}
ivec2 pixel_of_group(ivec2 first_pixel, int index) {
    return first_pixel + (is_interleaved ? 2 : 1) * ivec2(index & 1, index >> 1);
}

// Points of a disk, equally dense everywhere, the first one its centre (Vogel 1979, "A Better Way to Construct the
// Sunflower Head"), turned by a random angle. The radius is that of a disk with about three traced pixels per tap.
ivec2 rotated_offset(ivec2 pixel, int tap) {
    const float golden_turn = 0.38196601, radius = taps == 1u ? 2.0 : 4.0;
    float turn = random_pair(pixel, 0u, tap_dimension).x;
    float distance = radius * sqrt(float(tap) / float(max(tap_count - 1, 1)));
    return ivec2(round(distance * unit_circle(fract(turn + golden_turn * float(tap)))));
}

// 2x2 traced pixels, or 4x4 of which those are the middle. They hold the rays of the group's own pixels.
ivec2 shared_offset(int tap) {
    int spacing = is_interleaved && !half_resolution ? 2 : 1;
    ivec2 place = taps == 1u ? ivec2(tap & 1, tap >> 1) : ivec2(tap & 3, tap >> 2) - 1;
    return spacing * place;
}

ivec2 tap_position(ivec2 first_pixel, int tap) {
    ivec2 offset = is_shared ? shared_offset(tap) : rotated_offset(first_pixel, tap);
    return clamp(traced_of_pixel(first_pixel) + offset, ivec2(0), traced_extent() - 1);
}
#endif
