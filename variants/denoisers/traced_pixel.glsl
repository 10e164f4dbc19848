// Which pixels start rays. Needs the `camera` block.
#ifndef DENOISERS_TRACED_PIXEL_GLSL
#define DENOISERS_TRACED_PIXEL_GLSL
#include "denoisers/first_turn.h"

ivec2 traced_extent() {
    ivec2 extent = ivec2(camera.extent.xy);
    return half_resolution ? (extent + 1) / 2 : extent;
}

// Of 2x2 pixels the one whose turn it is: (0, 0), (1, 1), (1, 0), (0, 1).
ivec2 quad_pixel(uint turn) { return ivec2(turn ^ turn >> 1u, turn) & 1; }

// The pixel whose rays are those of the traced pixel q. With half_resolution each of the 2x2 has its turn once in four
// frames. A block that the border cuts has two pixels or one, and each of the two has its turn twice.
ivec2 traced_pixel(ivec2 q, uint frame) {
    if (!half_resolution) return q;
    return min(2 * q + quad_pixel(frame + first_turn(camera.frame.y)), ivec2(camera.extent.xy) - 1);
}

// Counts the turns of a pixel that has one in this frame: one after the other, as sequences are to be taken, of which a
// point in four leaves out three quarters of the square.
uint turn_of_pixel(ivec2 pixel) {
    if (!half_resolution) return camera.frame.x;
    ivec2 block = min(ivec2(camera.extent.xy) - (pixel & ~1), 2);
    return (camera.frame.x + (first_turn(camera.frame.y) & 3u)) / uint(block.x * block.y);
}

// In one word.
uint packed_pixel(ivec2 pixel) { return uint(pixel.x) | uint(pixel.y) << 16; }
#endif
