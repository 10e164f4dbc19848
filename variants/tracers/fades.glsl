// The factors by which the tracers' sources reduce the confidence of hits.
#ifndef TRACERS_FADES_GLSL
#define TRACERS_FADES_GLSL
#include "tracers/trace.glsl"

// Linear between two distances from the middle of the screen, whose border is at 1. `position`: un-jittered screen
// (pixels).
float edge_fade(vec2 position, float start, float end) {
    vec2 from_middle = abs(2.0 * position * camera.extent.zw - 1.0);
    return clamp((end - max(from_middle.x, from_middle.y)) / max(end - start, 1e-6), 0.0, 1.0);
}

float distance_fade(float distance, float max_distance) { return clamp(1.0 - distance / max_distance, 0.0, 1.0); }

// A hit of which the fade leaves nothing is a miss, for the reason given.
TraceEnd faded(TraceEnd end, float fade, uint outcome) {
    if (end.outcome != outcome_hit) return end;
    if (!(end.confidence * fade > 0.0)) return missed(outcome, end.position, end.distance);
    end.confidence *= fade;
    return end;
}
#endif
