// Mode SimpleLinear of an engine's reflection pass (its documentation, "Simple Linear Ray Marching"): equal steps on
// the screen, each of which compares the ray's device depth with that of the pixel it comes to.
#ifndef TRACERS_FIXED_STRIDE_GLSL
#define TRACERS_FIXED_STRIDE_GLSL
#include "tracers/fades.glsl"
#include "tracers/screen_line.glsl"
#include "tracers/stride.glsl"

const uint fixed_stride_step_uv = 1u;  // parameter `step`

// The step as printed is the direction in uv, normalised there, times the size of a texel: what was shares of the
// screen becomes as many pixels, and on screens that are not square the line turns towards their shorter side. Depth
// keeps pace with the way in uv (ours; the source does not say). t is pixels then.
ScreenLine fixed_stride_turned_line(ScreenLine line) {
    vec2 uv = line.slope.xy * camera.extent.zw, direction = normalize(uv);
    float t = length(direction * camera.extent.zw) / length(uv);  // of the line as it is, per pixel of the turned one
    line.slope = vec3(direction, line.slope.z * t);
    line.slope.xy = mix(line.slope.xy, vec2(slowest_slope), lessThan(abs(line.slope.xy), vec2(slowest_slope)));
    line.inverse = 1.0 / line.slope.xy;
    line.rate /= t;
    line.end = end_of_line(line);
    return line;
}

struct FixedStrideSample {
    ivec2 pixel;
    float surface;   // device depth
    bool is_behind;  // the ray; its own surface does not count
};

FixedStrideSample fixed_stride_sample(ScreenLine line, float t) {
    FixedStrideSample result;
    result.pixel = pixel_at(line, t);
    result.surface = fetch_depth(result.pixel);
    result.is_behind = !is_nearer(depth_at(line, t), result.surface) && !is_sky(result.surface, fixed_stride_sky_depth);
    if (fixed_stride_leave_own_surface && result.is_behind)
        // Where the ray passes the surface's depth: a step later it may be far above what it leaves.
        result.is_behind = result.pixel != line.pixel &&
                           !is_own_plane_at(line, result.pixel, result.surface, closest_t(line, result.surface, 0.0, t));
    return result;
}

// Ours where the source counts binary search steps, which its march never takes: halves the way from a place in front
// to one behind, down to where the ray falls behind.
float fixed_stride_refined(ScreenLine line, float t_front, float t_behind) {
    for (uint i = 0u; i < fixed_stride_binary_search_steps; ++i) {
        float middle = 0.5 * (t_front + t_behind);
        if (fixed_stride_sample(line, middle).is_behind)
            t_behind = middle;
        else
            t_front = middle;
    }
    return t_behind;
}

bool fixed_stride_is_thin(float ray_depth, float surface) {
    float scene_z = view_z(surface);
    return scene_z - view_z(ray_depth) < solid_depth(scene_z, fixed_stride_thickness, fixed_stride_relative_thickness);
}

TraceEnd fixed_stride_hit(ScreenLine line, TraceRay ray, ivec2 pixel, float t) {
    vec2 position = position_at(line, t);
    float ray_length = max(distance_at(line, t), 0.0);
    if (fixed_stride_front_faces_only && comes_from_behind(ray.direction, pixel))
        return missed(outcome_from_behind, position, ray_length);
    TraceEnd end = TraceEnd(pixel, position, ray_length, 1.0, outcome_hit);
    if (fixed_stride_edge_fade)
        end = faded(end, edge_fade(position, fixed_stride_fade_start, fixed_stride_fade_end), outcome_off_screen);
    if (fixed_stride_distance_fade)
        end = faded(end, distance_fade(ray_length, reach_of(fixed_stride_max_distance)), outcome_unfinished);
    return end;
}

TraceEnd fixed_stride_trace(TraceRay ray) {
    if (fixed_stride_reject_towards_camera && ray.direction.z > 0.0)
        return missed(outcome_behind_camera, screen_from_pixel(ray.pixel), 0.0);
    ScreenLine line = screen_line(ray);
    if (!fixed_stride_clip_to_near_plane) line = line_to_unclipped_end(line, reach_of(fixed_stride_max_distance));
    if (fixed_stride_step == fixed_stride_step_uv) line = fixed_stride_turned_line(line);
    float t_border = line.end;
    shorten_line(line, reach_of(fixed_stride_max_distance));

    // A ray along the view is a point on the screen, whose slope is none.
    float stride = stride_at(ray.origin.z, fixed_stride_stride, fixed_stride_stride_z_cutoff);
    float step = stride / clamp(length(line.slope.xy), 0.5, 2.0);
    // What only a hit needs comes after the loop: where both sides of a branch are run, each step would pay for it.
    float t_before = 0.0, t_hit = 0.0;
    ivec2 pixel_hit = ivec2(0);
    bool was_behind = false, is_hit = false, is_at_end = false;
    for (uint i = 0u; i < fixed_stride_max_steps && !is_hit; ++i) {
        float t = (float(i) + 1.0 - fixed_stride_jitter * ray.random) * step;
        is_at_end = t >= line.end;
        if (is_at_end) break;
        FixedStrideSample found = fixed_stride_sample(line, t);
        // Thickness counts where the ray fell behind: a ray that runs steeply into depth is far behind a step later.
        if (fixed_stride_refine && found.is_behind && !was_behind) {
            t_hit = fixed_stride_refined(line, t_before, t);
            FixedStrideSample refined = fixed_stride_sample(line, t_hit);
            pixel_hit = refined.pixel;
            is_hit = fixed_stride_is_thin(depth_at(line, t_hit), refined.surface);
        }
        if (!is_hit && found.is_behind) {
            t_hit = t;
            pixel_hit = found.pixel;
            is_hit = fixed_stride_is_thin(depth_at(line, t), found.surface);
        }
        was_behind = found.is_behind;
        t_before = t;
    }
    if (is_hit) return fixed_stride_hit(line, ray, pixel_hit, t_hit);
    if (is_at_end) return missed_on_line(line, line.end < t_border);
    line.end = min(line.end, t_before);
    return missed_on_line(line, true);
}
#endif
