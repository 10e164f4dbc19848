// The most that any tracer can find: what the ray meets in the scene, and whether the screen shows it.
// RayProbe::exact_hits of core/ray_probe.h answers between two passes, in the order of the records.
#ifndef TRACERS_EXACT_SCENE_GLSL
#define TRACERS_EXACT_SCENE_GLSL
#include "tracers/record.glsl"

struct ExactHit {
    vec2 position;
    float distance;
    uint outcome;
};
layout(std430) buffer exact_hits { ExactHit exact_hit_of_ray[]; };

// With exact_rays some rays are answered, and a march decides for the others.
bool exact_scene_answers(TraceRay ray) { return exact_hit_of_ray[record_index(ray)].outcome != outcome_unanswered; }

TraceEnd exact_scene_trace(TraceRay ray) {
    ExactHit found = exact_hit_of_ray[record_index(ray)];
    if (found.outcome != outcome_hit) return missed(found.outcome, found.position, found.distance);
    return TraceEnd(pixel_from_screen(found.position), found.position, found.distance, 1.0, outcome_hit);
}
#endif
