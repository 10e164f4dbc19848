// The march of rough surfaces' rays: equal steps on the screen, which may pass over thin objects; the blur hides it
// (slides). Number, start and end of the steps and their refinement are ssrlab's.
#ifndef TRACERS_FROSTBITE_LINEAR_GLSL
#define TRACERS_FROSTBITE_LINEAR_GLSL
#include "tracers/frostbite/solid.glsl"

// The step from t_in to t_out against what is seen at its end.
FrostbiteEnd frostbite_meet_at_end(ScreenLine line, float t_in, float t_out) {
    ivec2 pixel = pixel_at(line, t_out);
    return frostbite_meet(line, pixel, fetch_depth(pixel), t_in, t_out, depth_at(line, t_out));
}

// Halves the step that hit down to a pixel; the halves' ends may miss what its own end met.
FrostbiteEnd frostbite_refine(ScreenLine line, FrostbiteEnd end, float t_in, float t_out) {
    const float pixel = 1.01;  // rounding must not halve steps of one pixel
    for (uint i = 0u; i < frostbite_linear_refinements && t_out - t_in > pixel; ++i) {
        float middle = 0.5 * (t_in + t_out);
        FrostbiteEnd nearer = frostbite_meet_at_end(line, t_in, middle);
        if (nearer.is_hit) {
            end = nearer;
            t_out = middle;
        } else {
            t_in = middle;
        }
    }
    return end;
}

// The random number is the length of the first step, in steps; the last one is what is left. The others are no shorter than
// a pixel. A ray hits if it is behind the surface at a step's end and was not behind all of its solid part on the whole
// step. That it was farther on its way does not count: the surface of some other pixel was there.
TraceEnd frostbite_linear_trace(TraceRay ray) {
    ScreenLine line = screen_line(ray);
    float stride = max(line.end / float(frostbite_linear_steps), 1.0);
    float t_in = 0.5, t_out = t_in;  // where it leaves its own pixel
    FrostbiteEnd end = frostbite_no_hit;
    bool is_last = false;
    // What only a hit needs comes after the loop: where both sides of a branch are run, each step would pay for it.
    for (uint step = 0u; !is_last && !end.is_hit; ++step) {
        t_out = (float(step) + ray.random) * stride;
        is_last = step == frostbite_linear_steps || t_out >= line.end;
        if (is_last) t_out = line.end;
        if (pixel_at(line, t_out) == line.pixel) continue;
        end = frostbite_meet_at_end(line, t_in, t_out);
        if (!end.is_hit) t_in = t_out;
    }
    if (end.is_hit) end = frostbite_refine(line, end, t_in, t_out);
    return frostbite_end(line, end, ray, false);
}
#endif
