// Which pixels start rays. Needs the `camera` block.
#ifndef FROSTBITE_SSSR_TRACED_PIXEL_GLSL
#define FROSTBITE_SSSR_TRACED_PIXEL_GLSL

ivec2 traced_extent() {
    ivec2 extent = ivec2(camera.extent.xy);
    return half_resolution ? (extent + 1) / 2 : extent;
}

// Of 2x2 pixels the one whose turn it is: (0, 0), (1, 1), (1, 0), (0, 1).
ivec2 quad_pixel(uint turn) { return ivec2(turn ^ turn >> 1u, turn) & 1; }

// The pixel whose rays are those of the traced pixel q. With half_resolution each of the 2x2 has its turn once in four
// frames, and once in four seeds, so that their mean over seeds favours none. A block that the border cuts has fewer
// pixels, whose turns come more often.
ivec2 traced_pixel(ivec2 q, uint frame) {
    if (!half_resolution) return q;
    return min(2 * q + quad_pixel(frame + camera.frame.y), ivec2(camera.extent.xy) - 1);
}
#endif
