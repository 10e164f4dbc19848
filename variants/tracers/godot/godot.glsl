// The march of Godot 4.6: through a pyramid of nearest depths, a level coarser after each cell in which the ray stays
// in front and a level finer where it comes behind, straight to the depth of the cell's nearest surface. Only single
// pixels show whether an object is thin; behind a thin one the ray goes on pixel by pixel.
#ifndef TRACERS_GODOT_GLSL
#define TRACERS_GODOT_GLSL
#include "common/depth_pyramid.glsl"
#include "tracers/fades.glsl"
#include "tracers/screen_cells.glsl"

const uint godot_back_faces_near = 0u;      // parameter `back_faces`
const float godot_near_pixels = 2.0;        // from the ray's start, on both axes, within which Godot asks for faces
const float godot_margin = 0.05;            // of width and height together, over which hits fade out at the border
const float godot_bias_power = 8.0;         // of the cosine between both normals
const float godot_full_confidence = 0.999;  // of the fades' product, from which on there is none

// The ray as Godot begins it: off the surface by what its normals differ, and never into it.
TraceRay godot_begun(TraceRay ray) {
    vec3 up = ray.geometric_normal;
    if (godot_bounce && dot(ray.direction, up) < 0.0) ray.direction = reflect(ray.direction, up);
    if (godot_normal_bias == 0.0) return ray;
    float alike = clamp(dot(view_normal(ray.pixel), up), 0.0, 1.0);
    vec3 above = ray.origin + godot_normal_bias * (1.0 - pow(alike, godot_bias_power)) * up;
    if (above.z < -camera.depth.x) ray.origin = above;  // behind the camera there is no line
    return ray;
}

// Its line, which begins at its origin also where that was moved off the pixel's surface.
ScreenLine godot_line(TraceRay ray) {
    ScreenLine line = screen_line(ray);
    if (godot_normal_bias == 0.0) return line;
    vec3 origin = image_from_view(ray.origin);
    line.origin = vec3(origin.xy * camera.extent.xy, origin.z);
    line.pixel = pixel_at(line, 0.0);
    line.end = end_of_line(line);
    return line;
}

// The pixel at t in the cell that the line enters at `pixel`.
ivec2 godot_pixel_in_cell(ScreenLine line, ivec2 pixel, int level, float t) {
    ivec2 low = pixel >> level << level, size = ivec2((1 << level) - 1);
    ivec2 last = low + ivec2(greaterThan(line.slope.xy, vec2(0.0))) * size;
    return clamp(pixel_at(line, t), min(pixel, last), max(pixel, last));
}

// Whether a ray that comes no nearer than a device depth is behind all that counts as solid of a surface.
bool godot_is_behind_solid(float nearest, float surface) {
    float scene_z = view_z(surface);
    return scene_z - view_z(nearest) > solid_depth(scene_z, godot_thickness, godot_relative_thickness);
}

// 1 on the surface, 0 from a thickness away from it on.
float godot_distance_confidence(vec2 uv, float ray_depth, float surface) {
    float solid = solid_depth(view_z(surface), godot_thickness, godot_relative_thickness);
    float away = distance(view_from_image(vec3(uv, ray_depth)), view_from_image(vec3(uv, surface)));
    float near = 1.0 - smoothstep(0.0, max(solid, 1e-20), away);
    return near * near;
}

// By the product of both axes' distances from the border (pixels), which Godot takes from where the previous frame saw
// the place.
float godot_margin_fade(vec2 uv) {
    vec2 from_border = min(uv, 1.0 - uv) * camera.extent.xy;
    float margin = godot_margin * (camera.extent.x + camera.extent.y);
    return smoothstep(0.0, margin * margin, max(from_border.x, 0.0) * max(from_border.y, 0.0));
}

float godot_fade(float share, float power) { return power == 0.0 ? 1.0 : pow(clamp(share, 0.0, 1.0), power); }

// Where the walk ended, judged. `surface`: device depth of what the pixel shows.
TraceEnd godot_judged(ScreenLine line, TraceRay ray, ivec2 pixel, float t, float surface) {
    vec2 position = position_at(line, t), way = abs(t * line.slope.xy);
    float ray_length = max(distance_at(line, t), 0.0);
    if (is_background(surface)) return missed(outcome_background, position, ray_length);
    bool is_near = all(lessThan(way, vec2(godot_near_pixels)));
    if ((is_near || godot_back_faces != godot_back_faces_near) && comes_from_behind(ray.direction, pixel))
        return missed(outcome_from_behind, position, ray_length);
    vec2 uv = (position - camera.jitter.xy) * camera.extent.zw;
    TraceEnd end = TraceEnd(pixel, position, ray_length, 1.0, outcome_hit);
    if (godot_fade_off_surface)
        end = faded(end, godot_distance_confidence(uv, depth_at(line, t), surface), outcome_too_thick);
    if (godot_fade_at_border) end = faded(end, godot_margin_fade(uv), outcome_off_screen);
    float share = length(way * camera.extent.zw);  // of width and height, as Godot counts
    float fade = godot_fade(share, godot_fade_in) * godot_fade(1.0 - share, godot_fade_out);
    return faded(end, fade > godot_full_confidence ? 1.0 : fade, outcome_unfinished);
}

TraceEnd godot_trace(TraceRay given) {
    TraceRay ray = godot_begun(given);
    ScreenLine line = godot_line(ray);
    bool goes_away = is_farther(line.slope.z, 0.0);
    int coarsest = depth_pyramid_coarsest(godot_pyramid_mips), level = 0;
    CellExit here = exit_of_cell(line, line.pixel, 0);  // not its own pixel
    // What only a hit needs comes after the loop: where both sides of a branch are run, each step would pay for it.
    float surface = 0.0, t_met = 0.0;
    bool is_met = false, is_at_end = false;
    for (uint i = 0u; i < godot_max_steps; ++i) {
        is_at_end = here.t >= line.end;
        if (is_at_end) break;
        level = existing_level(here.pixel, level);
        CellExit ahead = exit_of_cell(line, here.pixel, level);
        float t_out = min(ahead.t, line.end), depth_in = depth_at(line, here.t), depth_out = depth_at(line, t_out);
        count_fetch();
        surface = texelFetch(depth_pyramid, here.pixel >> level, level).r;
        if (is_nearer(farther_of(depth_in, depth_out), surface)) {
            here = ahead;
            level = min(level + 1, coarsest);
            continue;
        }
        // Up to the depth of the nearest surface there is nothing to meet.
        t_met = goes_away || godot_interval ? closest_t(line, surface, here.t, t_out) : here.t;
        if (level > 0) {
            if (goes_away) here = CellExit(t_met, godot_pixel_in_cell(line, here.pixel, level, t_met));
            --level;
            continue;
        }
        float nearest = godot_interval ? nearer_of(depth_in, depth_out) : depth_in;  // the flaw: where it enters
        is_met = !is_background(surface) && !godot_is_behind_solid(nearest, surface) &&
                 !(godot_leave_own_plane && is_own_plane_at(line, here.pixel, surface, t_met));
        if (is_met) break;
        here = ahead;
    }
    if (is_met) return godot_judged(line, ray, here.pixel, t_met, surface);
    if (is_at_end) return missed_on_line(line, false);
    if (!godot_reject_unfinished)  // the flaw: wherever it stands
        return godot_judged(line, ray, here.pixel, here.t, fetch_depth(here.pixel));
    line.end = min(line.end, here.t);
    return missed_on_line(line, true);
}
#endif
