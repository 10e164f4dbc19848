// Mode HiZ of an engine's reflection pass (its documentation, "Hi-Z Ray Marching"): from wall to wall of a depth
// pyramid's cells. The level gets coarser after some cells in which the ray stayed in front, and finer where the ray is
// behind. Ours: a ray that is behind something passes on in cells of up to `behind_level`.
#ifndef TRACERS_CELLS_GLSL
#define TRACERS_CELLS_GLSL
#include "common/depth_pyramid.glsl"
#include "tracers/fades.glsl"
#include "tracers/screen_cells.glsl"

const uint cells_back_faces_fade = 1u, cells_back_faces_reject = 2u;  // parameter `back_faces`

// Whether a ray that comes no nearer than a device depth is behind all that counts as solid of a surface.
bool cells_is_behind_solid(float nearest, float surface) {
    float scene_z = view_z(surface);
    return view_z(nearest) < scene_z - solid_depth(scene_z, cells_thickness, cells_relative_thickness);
}

// A hit loses what its surface is turned away, and what the ray is near to the plane that it leaves.
TraceEnd cells_hit(ScreenLine line, TraceRay ray, ivec2 pixel, float t) {
    vec2 position = position_at(line, t);
    float ray_length = max(distance_at(line, t), 0.0);
    TraceEnd end = TraceEnd(pixel, position, ray_length, 1.0, outcome_hit);
    if (cells_back_faces == cells_back_faces_reject && comes_from_behind(ray.direction, pixel))
        return missed(outcome_from_behind, position, ray_length);
    if (cells_back_faces == cells_back_faces_fade)
        end = faded(end, clamp(1.0 - dot(ray.direction, view_geometric_normal(pixel)), 0.0, 1.0), outcome_from_behind);
    if (cells_edge_fade)
        end = faded(end, edge_fade(position, cells_fade_start, cells_fade_end), outcome_off_screen);
    if (cells_distance_fade)
        end = faded(end, distance_fade(ray_length, reach_of(cells_max_distance)), outcome_unfinished);
    if (cells_grazing_fade > 0.0)
        end = faded(end, clamp(line.rise / cells_grazing_fade, 0.0, 1.0), outcome_own_surface);
    return end;
}

TraceEnd cells_trace(TraceRay ray) {
    ScreenLine line = screen_line(ray);
    if (!cells_clip_to_near_plane) line = line_to_unclipped_end(line, reach_of(cells_max_distance));
    float t_border = line.end;
    shorten_line(line, reach_of(cells_max_distance));

    int coarsest = depth_pyramid_coarsest(cells_pyramid_mips), level = 0;
    int behind_level = min(int(cells_behind_level), coarsest);
    uint safe_steps = 0u;
    bool recedes = is_farther(line.slope.z, 0.0);  // from the camera
    CellExit here = exit_of_cell(line, line.pixel, 0);  // not its own pixel
    // What only a hit needs comes after the loop: where both sides of a branch are run, each step would pay for it.
    float t_hit = 0.0;
    bool is_hit = false, is_at_end = false;
    bool is_behind = false;  // what the last cell showed
    for (uint i = 0u; i < cells_max_steps; ++i) {
        is_at_end = here.t >= line.end;
        if (is_at_end) break;
        level = existing_level(here.pixel, level);
        CellExit ahead = exit_of_cell(line, here.pixel, level);
        float t_out = cells_interval ? min(ahead.t, line.end) : here.t;  // the flaw: only where it enters
        count_fetch();
        float surface = texelFetch(depth_pyramid, here.pixel >> level, level).r;
        if (is_nearer(depth_at(line, recedes ? t_out : here.t), surface)) {
            here = ahead;
            is_behind = false;
            if (++safe_steps < cells_safe_steps) continue;
            level = min(level + 1, coarsest);
            if (cells_reset_safe_steps) safe_steps = 0u;
            continue;
        }
        safe_steps = 0u;
        if (level > (is_behind ? behind_level : 0)) {
            --level;
            continue;
        }
        t_hit = closest_t(line, surface, here.t, t_out);
        bool is_met = !is_sky(surface, cells_sky_depth) &&
                      !cells_is_behind_solid(depth_at(line, recedes ? here.t : t_out), surface);
        if (is_met && level > 0) {
            is_behind = false;
            --level;
            continue;
        }
        is_hit = is_met && !(cells_leave_own_plane && is_own_plane_at(line, here.pixel, surface, t_hit));
        if (is_hit) break;
        here = ahead;
        is_behind = !is_met;
        if (is_behind) level = min(level + 1, behind_level);
    }
    if (is_hit) return cells_hit(line, ray, here.pixel, t_hit);
    if (is_at_end) return missed_on_line(line, line.end < t_border);
    line.end = min(line.end, here.t);
    return missed_on_line(line, true);
}
#endif
