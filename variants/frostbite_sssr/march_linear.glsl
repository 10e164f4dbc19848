// The march of rough surfaces' rays: equal steps on the screen, which may pass over thin things; the blur hides it
// (slides). Number, start and end of the steps are ours.
#ifndef FROSTBITE_SSSR_MARCH_LINEAR_GLSL
#define FROSTBITE_SSSR_MARCH_LINEAR_GLSL
#include "frostbite_sssr/solid.glsl"

ivec2 pixel_at(ScreenLine line, float t) {
    return clamp(ivec2(floor(line.origin.xy + t * line.slope.xy)), ivec2(0), ivec2(camera.extent.xy) - 1);
}

// `jitter` in [0, 1): length of the first step, in steps. Steps are no shorter than a pixel. A ray hits if it is behind
// the surface at a step's end and was not behind all of its solid part on the whole step. That it was farther on its way
// does not count: the surface of some other pixel was there.
March march_linear(ScreenLine line, float jitter) {
    float stride = max(line.end / float(linear_steps), 1.0);
    float t_in = 0.5;  // where it leaves its own pixel
    for (uint step = 0u; step < linear_steps; ++step) {
        float t_out = (float(step) + jitter) * stride;
        if (t_out >= line.end) break;
        ivec2 pixel = pixel_at(line, t_out);
        if (pixel == line.pixel) continue;
        March end = meet(line, pixel, texelFetch(depth, pixel, 0).r, t_in, t_out, depth_at(line, t_out));
        if (end.is_hit) return end;
        t_in = t_out;
    }
    return miss;
}
#endif
