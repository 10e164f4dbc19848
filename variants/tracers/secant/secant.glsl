// The march of Bevy's reflections, a port of Stachowiak's raymarch.hlsl: a few equal steps between the ray's start and
// the border of the screen. The first step that ends behind the visible surface is halved repeatedly; one step of the
// secant method follows. A place is behind only if it is behind the depth of its pixel and the depth interpolated
// between the four nearest pixels. The first depth alone is a stair that catches rays near their own surface; the
// second alone joins separate surfaces.
#ifndef TRACERS_SECANT_GLSL
#define TRACERS_SECANT_GLSL
#include "tracers/screen_line.glsl"

const uint secant_behind_end = 0u, secant_behind_skip = 1u, secant_behind_go_on = 2u;  // parameter `behind`
const float secant_depth_bias = 2e-6;  // of the depth, by which surfaces are taken for farther than they are: Bevy's
const float secant_improvement = 0.9;  // of the distance before it, which the secant's must be below: Bevy's
const float secant_projected_step = 1.0;  // m, whose end's projection gives Bevy's line its direction

// The ray against what is seen at a place on its line.
struct SecantSample {
    float t;
    ivec2 pixel;
    float in_front;         // of both surfaces, by depth (m); negative behind both
    float device_in_front;  // the same of device depth, in which rays and planes are straight
    float inside;           // behind the surface that thickness is measured from (m)
    float solid;            // thickness (m)
};

bool secant_is_behind(SecantSample place) { return place.in_front < 0.0; }
bool secant_is_solid(SecantSample place) { return place.inside < place.solid; }

// Neither farther behind what is seen than it is thick, nor as far before it.
bool secant_is_close(SecantSample place) { return secant_is_solid(place) && place.in_front < place.solid; }

float secant_fetch(ivec2 pixel) { return fetch_depth(clamp(pixel, ivec2(0), ivec2(camera.extent.xy) - 1)); }

// Whether the farthest of four pixels is behind all that counts as solid of the nearest.
bool secant_lie_apart(vec4 depths) {
    float nearest = camera_depth(nearer_of(nearer_of(depths.x, depths.y), nearer_of(depths.z, depths.w))),
          farthest = camera_depth(farther_of(farther_of(depths.x, depths.y), farther_of(depths.z, depths.w)));
    return farthest - nearest > solid_depth(-nearest, secant_thickness, secant_relative_thickness);
}

SecantSample secant_sample(ScreenLine line, TraceRay ray, float t) {
    SecantSample place;
    place.t = t;
    place.pixel = pixel_at(line, t);
    float depth_here = depth_at(line, t), of_pixel, between;
    if (secant_both_surfaces) {
        vec2 from_centers = line.origin.xy + t * line.slope.xy - 0.5, corner = floor(from_centers),
             part = from_centers - corner;
        ivec2 low = ivec2(corner);
        vec4 depths = vec4(secant_fetch(low), secant_fetch(low + ivec2(1, 0)), secant_fetch(low + ivec2(0, 1)),
                           secant_fetch(low + ivec2(1, 1)));
        between = mix(mix(depths.x, depths.y, part.x), mix(depths.z, depths.w, part.x), part.y);
        vec2 column = place.pixel.x > low.x ? depths.yw : depths.xz;
        of_pixel = place.pixel.y > low.y ? column.y : column.x;
        if (secant_split_apart && secant_lie_apart(depths)) between = of_pixel;
    } else {
        of_pixel = fetch_depth(place.pixel);
        between = of_pixel;
    }
    float farther = farther_of(of_pixel, between), ray_depth = camera_depth(depth_here);
    place.in_front = camera_depth(farther) * (1.0 + secant_depth_bias) - ray_depth;
    place.device_in_front = is_reversed() ? depth_here - farther : farther - depth_here;
    place.inside = ray_depth - camera_depth(secant_thickness_from_nearer ? nearer_of(of_pixel, between) : of_pixel);
    place.solid = solid_depth(-camera_depth(of_pixel), secant_thickness, secant_relative_thickness);
    bool is_passed = is_background(of_pixel) ||
                     (secant_leave_own_surface && is_own_surface(ray, place.pixel, of_pixel, distance_at(line, t)));
    if (is_passed) {
        place.in_front = max(place.in_front, 0.0);
        place.device_in_front = max(place.device_in_front, 0.0);
    }
    return place;
}

// Whether the step from `before` to `here` is to be halved.
bool secant_step_meets(SecantSample before, SecantSample here) {
    if (!secant_is_behind(here) || secant_behind == secant_behind_end) return secant_is_behind(here);
    return secant_is_solid(here) || (secant_behind == secant_behind_go_on && !secant_is_behind(before));
}

// Where the ray is by the secant between a place in front and one behind.
SecantSample secant_step(ScreenLine line, TraceRay ray, SecantSample before, SecantSample here) {
    float start = secant_of_device_depth ? before.device_in_front : before.in_front,
          end = secant_of_device_depth ? here.device_in_front : here.in_front;
    return secant_sample(line, ray, mix(before.t, here.t, clamp(start / max(start - end, 1e-30), 0.0, 1.0)));
}

// The place on the step to `here` at which the ray comes behind what is seen.
SecantSample secant_refined(ScreenLine line, TraceRay ray, SecantSample before, SecantSample here) {
    // What only hides the ray on its way to something solid is not what it meets.
    bool is_solid = secant_behind == secant_behind_skip ||
                    (secant_behind == secant_behind_go_on && secant_is_solid(here));
    for (uint i = 0u; i < secant_bisections; ++i) {
        SecantSample middle = secant_sample(line, ray, 0.5 * (before.t + here.t));
        if (secant_is_behind(middle) && (!is_solid || secant_is_solid(middle)))
            here = middle;
        else
            before = middle;
    }
    if (!secant_secant_step) return here;
    // Before the first step's end nothing is known: its distance of 0 leaves the secant's place unused.
    SecantSample found = secant_step(line, ray, before, here);
    bool is_better = abs(found.in_front) < secant_improvement * before.in_front &&
                     (!is_solid || secant_is_solid(found));
    if (is_better && (secant_is_close(found) || !secant_keep_bisection)) here = found;
    return here;
}

TraceEnd secant_judged(ScreenLine line, TraceRay ray, SecantSample found) {
    vec2 position = position_at(line, found.t);
    float ray_length = max(distance_at(line, found.t), 0.0);
    if (!secant_is_close(found)) return missed(outcome_too_thick, position, ray_length);
    if (secant_front_faces_only && comes_from_behind(ray.direction, found.pixel))
        return missed(outcome_from_behind, position, ray_length);
    return TraceEnd(found.pixel, position, ray_length, 1.0, outcome_hit);
}

TraceEnd secant_trace(TraceRay ray) {
    ScreenLine line = screen_line(ray);
    if (!secant_clip_to_near_plane) line = line_to_unclipped_end(line, secant_projected_step);
    float pixels = floor(line.end * length(line.slope.xy)), steps = max(min(float(secant_linear_steps), pixels), 2.0);
    float first = secant_random_start ? ray.random : 1.0;
    uint count = uint(steps);
    if (secant_search_last_step && first < 1.0) ++count;

    SecantSample here = SecantSample(0.0, line.pixel, 0.0, 0.0, 0.0, 0.0), before = here;
    TraceEnd end = missed_on_line(line, false);
    // Each round goes to the next step that meets something, so that the refinement is not paid for in each step.
    for (uint step = 0u; step < count;) {
        bool is_met = false;
        for (; step < count && !is_met; ++step) {
            before = here;
            float share = pow(min((float(step) + first) / steps, 1.0), secant_exponent);
            here = secant_sample(line, ray, share * line.end);
            is_met = secant_step_meets(before, here);
        }
        if (!is_met) break;
        TraceEnd met = secant_judged(line, ray, secant_refined(line, ray, before, here));
        if (met.outcome == outcome_too_thick && secant_behind == secant_behind_go_on) continue;
        return met;
    }
    return end;
}
#endif
