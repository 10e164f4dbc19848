// The plain march that the slides on stochastic reflections begin with: equal steps along the ray in view space, with
// each point projected and compared with the depth there. Refinement and confidence are those of Lettier's tutorial.
#ifndef TRACERS_VIEW_SPACE_GLSL
#define TRACERS_VIEW_SPACE_GLSL
#include "tracers/fades.glsl"
#include "tracers/own_plane.glsl"

struct ViewSpaceSample {
    float distance;  // along the ray (m)
    vec2 position;   // un-jittered screen (pixels)
    ivec2 pixel;
    bool is_on_screen, is_met;
    float behind;    // of the surface seen there, the ray's point, over what counts as solid: met from 0 to 1
};

ViewSpaceSample view_space_sample(TraceRay ray, float distance) {
    ViewSpaceSample found;
    vec3 point = ray.origin + distance * ray.direction;
    found.distance = distance;
    found.position = screen_from_view(point).xy * camera.extent.xy;
    found.pixel = pixel_from_screen(found.position);
    found.is_on_screen = is_on_screen(found.pixel);
    found.is_met = false;
    found.behind = -1.0;
    if (!found.is_on_screen) return found;
    float surface = fetch_depth(found.pixel);
    if (is_background(surface)) return found;
    float scene_z = view_z(surface);
    float solid = solid_depth(scene_z, view_space_thickness, view_space_relative_thickness);
    found.behind = (scene_z - point.z) / max(solid, 1e-20);
    found.is_met = found.behind > 0.0 && found.behind < 1.0 &&
                   !(view_space_leave_own_surface && is_own_surface(ray, found.pixel, surface, distance));
    return found;
}

// Halves the way to the step that met something. `front`: the distance before it (m).
ViewSpaceSample view_space_refined(TraceRay ray, ViewSpaceSample coarse, float front) {
    ViewSpaceSample best = coarse, last = coarse;
    bool has_met = view_space_refinements == 0u;
    for (uint i = 0u; i < view_space_refinements; ++i) {
        last = view_space_sample(ray, 0.5 * (front + best.distance));
        if (last.is_met)
            best = last;
        else
            front = last.distance;
        has_met = has_met || last.is_met;
    }
    if (view_space_return_best) return best;
    // As printed: a hit if any half met something, though the one that is returned may not.
    if (!view_space_test_returned) last.is_met = has_met;
    return last;
}

float view_space_visibility(TraceRay ray, ViewSpaceSample found, float reach) {
    float towards_camera = max(dot(-view_direction(ray.origin), ray.direction), 0.0);
    return (1.0 - towards_camera) * clamp(1.0 - found.behind, 0.0, 1.0) * distance_fade(found.distance, reach);
}

TraceEnd view_space_trace(TraceRay ray) {
    float reach = view_space_max_distance + view_space_relative_max_distance * -ray.origin.z, way = reach;
    uint outcome = outcome_unfinished;
    if (view_space_clip_to_near_plane && ray.direction.z > 0.0) {
        float to_near_plane = max((-camera.depth.x - ray.origin.z) / ray.direction.z, 0.0);
        if (to_near_plane < way) outcome = outcome_behind_camera;
        way = min(way, to_near_plane);
    }
    ViewSpaceSample found;
    found.position = screen_from_pixel(ray.pixel);
    found.distance = 0.0;
    // What only a hit needs comes after the loop: where both sides of a branch are run, each step would pay for it.
    float before = 0.0;
    bool is_over = false;
    for (uint i = 1u; i <= view_space_steps && !is_over; ++i) {
        before = found.distance;
        found = view_space_sample(ray, way * float(i) / float(view_space_steps));
        // What has left the screen comes back only from behind the camera.
        is_over = found.is_met || (!found.is_on_screen && view_space_clip_to_near_plane);
    }
    if (!is_over) return missed(outcome, found.position, found.distance);
    if (found.is_met) found = view_space_refined(ray, found, before);
    if (!found.is_on_screen) return missed(outcome_off_screen, found.position, found.distance);
    if (!found.is_met) return missed(outcome_too_thick, found.position, found.distance);
    if (view_space_front_faces_only && comes_from_behind(ray.direction, found.pixel))
        return missed(outcome_from_behind, found.position, found.distance);
    TraceEnd end = TraceEnd(found.pixel, found.position, found.distance, 1.0, outcome_hit);
    if (!view_space_visibility_fade) return end;
    return faded(end, view_space_visibility(ray, found, reach), outcome_too_thick);
}
#endif
