// The march of smooth surfaces' rays through a depth pyramid: from pixel to pixel, a level coarser where the line meets
// nothing of a cell, a level finer where it may (slides).
// Ours, since the slides stop at the first surface that a ray falls behind: a cell is passed over if the line, from
// where it enters to where it leaves, is in front of the nearest surface in it or behind the solid part of the farthest.
// That holds for rays towards the camera, too, and lets rays that have fallen behind things climb again, but needs a
// second pyramid. At the finest level a ray that meets nothing solid goes on. The result is that of looking at every
// pixel along the line.
#ifndef TRACERS_FROSTBITE_HIERARCHICAL_GLSL
#define TRACERS_FROSTBITE_HIERARCHICAL_GLSL
#include "common/depth_pyramid.glsl"
#include "tracers/frostbite/solid.glsl"
#include "tracers/screen_cells.glsl"

uniform sampler2D farthest_depth_pyramid;

// Cells that a ray may pass before it counts as a miss. A line crosses no more pixels than a row and a column have
// together, so that by default no ray runs out of them. Looks at coarser cells that the march then leaves for finer
// ones do not count; there are no more than one per cell that was passed.
uint frostbite_most_cells() {
    return frostbite_max_hierarchical_steps > 0u ? frostbite_max_hierarchical_steps : uint(camera.extent.x + camera.extent.y);
}

bool frostbite_passes_behind(float nearest, ivec2 cell, int level) {
    count_fetch();
    return frostbite_is_behind_solid(nearest, texelFetch(farthest_depth_pyramid, cell, level).r);
}

TraceEnd frostbite_hierarchical_trace(TraceRay ray) {
    ScreenLine line = screen_line(ray);
    int coarsest = depth_pyramid_coarsest(frostbite_pyramid_mips), level = 0;
    CellExit here = exit_of_cell(line, line.pixel, 0);  // not its own pixel
    FrostbiteEnd end = frostbite_no_hit;
    for (uint passed = 0u, most = frostbite_most_cells(); passed < most && here.t < line.end;) {
        level = existing_level(here.pixel, level);
        ivec2 cell = here.pixel >> level;
        CellExit ahead = exit_of_cell(line, here.pixel, level);
        float t_out = min(ahead.t, line.end);
        float depth_in = depth_at(line, here.t), depth_out = depth_at(line, t_out);
        float nearest = nearer_of(depth_in, depth_out), farthest = farther_of(depth_in, depth_out);
        count_fetch();
        float surface = texelFetch(depth_pyramid, cell, level).r;
        bool is_passed = is_nearer(farthest, surface) || frostbite_passes_behind(nearest, cell, level);
        if (!is_passed && level > 0) {
            --level;
            continue;
        }
        if (!is_passed) {
            end = frostbite_meet(line, here.pixel, surface, here.t, t_out, farthest);
            if (end.is_hit) break;
        }
        here = ahead;
        ++passed;
        if (is_passed) level = min(level + 1, coarsest);
    }
    return frostbite_end(line, end, ray, here.t < line.end);
}
#endif
