// The march of rough surfaces' rays: equal steps on the screen, which may pass over thin things; the blur hides it
// (slides). Number, start and end of the steps and their refinement are ours.
#ifndef FROSTBITE_SSSR_MARCH_LINEAR_GLSL
#define FROSTBITE_SSSR_MARCH_LINEAR_GLSL
#include "frostbite_sssr/solid.glsl"

ivec2 pixel_at(ScreenLine line, float t) {
    return clamp(ivec2(floor(line.origin.xy + t * line.slope.xy)), ivec2(0), ivec2(camera.extent.xy) - 1);
}

// The step from t_in to t_out against what is seen at its end.
March meet_at_end(ScreenLine line, float t_in, float t_out) {
    ivec2 pixel = pixel_at(line, t_out);
    return meet(line, pixel, texelFetch(depth, pixel, 0).r, t_in, t_out, depth_at(line, t_out));
}

// Halves the step that hit down to a pixel; the halves' ends may miss what its own end met.
March refine(ScreenLine line, March end, float t_in, float t_out) {
    const float pixel = 1.01;  // rounding must not halve steps of one pixel
    for (uint i = 0u; i < linear_refinements && t_out - t_in > pixel; ++i) {
        float middle = 0.5 * (t_in + t_out);
        March nearer = meet_at_end(line, t_in, middle);
        if (nearer.is_hit) {
            end = nearer;
            t_out = middle;
        } else {
            t_in = middle;
        }
    }
    return end;
}

// `jitter` in [0, 1): length of the first step, in steps; the last one is what is left. The others are no shorter than
// a pixel. A ray hits if it is behind the surface at a step's end and was not behind all of its solid part on the whole
// step. That it was farther on its way does not count: the surface of some other pixel was there.
March march_linear(ScreenLine line, float jitter) {
    float stride = max(line.end / float(linear_steps), 1.0);
    float t_in = 0.5;  // where it leaves its own pixel
    bool is_last = false;
    for (uint step = 0u; !is_last; ++step) {
        float t_out = (float(step) + jitter) * stride;
        is_last = step == linear_steps || t_out >= line.end;
        if (is_last) t_out = line.end;
        if (pixel_at(line, t_out) == line.pixel) continue;
        March end = meet_at_end(line, t_in, t_out);
        if (end.is_hit) return refine(line, end, t_in, t_out);
        t_in = t_out;
    }
    return miss;
}
#endif
