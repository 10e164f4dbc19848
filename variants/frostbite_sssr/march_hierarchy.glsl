// The march of smooth surfaces' rays through the pyramid of nearest depths: from pixel to pixel, a level coarser where
// the line stays in front of all that a cell shows, a level finer where it does not (slides).
// Ours, since the slides stop at the first surface that a ray falls behind: a cell is passed over only if the line is
// in front of it where it enters and where it leaves, which holds for rays towards the camera, too; at the finest level
// a ray that meets nothing solid goes on behind it. The result is that of looking at every pixel along the line.
#ifndef FROSTBITE_SSSR_MARCH_HIERARCHY_GLSL
#define FROSTBITE_SSSR_MARCH_HIERARCHY_GLSL
#include "frostbite_sssr/solid.glsl"

uniform sampler2D depth_pyramid;

// Where a line leaves a cell.
struct Exit {
    float t;
    ivec2 pixel;  // that it enters there
};

// Cells are told by integers: no rounding can put a line on the wrong side of a wall.
Exit exit_of_cell(ScreenLine line, ivec2 pixel, int level) {
    ivec2 low = pixel >> level << level, high = low + (1 << level) - 1;
    bvec2 ascends = greaterThan(line.slope.xy, vec2(0.0));
    ivec2 last = mix(low, high, ascends);
    vec2 walls = vec2(mix(low, high + 1, ascends));
    vec2 t_walls = (walls - line.origin.xy) * line.inverse;
    bool is_x = t_walls.x < t_walls.y;
    float t = is_x ? t_walls.x : t_walls.y;
    ivec2 next = ivec2(floor(line.origin.xy + t * line.slope.xy));
    next = clamp(next, min(pixel, last), max(pixel, last));
    if (is_x)
        next.x = ascends.x ? high.x + 1 : low.x - 1;
    else
        next.y = ascends.y ? high.y + 1 : low.y - 1;
    return Exit(t, next);
}

// Levels leave out the last row or column of odd ones: what they lack is looked at on finer levels.
int existing_level(ivec2 pixel, int level) {
    while (any(greaterThanEqual(pixel >> level, ivec2(camera.extent.xy) >> level))) --level;
    return level;
}

// A ray that runs out of steps counts as a miss.
March march_hierarchy(ScreenLine line) {
    int coarsest = textureQueryLevels(depth_pyramid) - 1, level = 0;
    Exit here = exit_of_cell(line, line.pixel, 0);  // not its own pixel
    for (uint step = 0u; step < max_hierarchical_steps && here.t < line.end; ++step) {
        level = existing_level(here.pixel, level);
        float surface = texelFetch(depth_pyramid, here.pixel >> level, level).r;
        Exit ahead = exit_of_cell(line, here.pixel, level);
        float t_out = min(ahead.t, line.end);
        float farthest = farther_of(depth_at(line, here.t), depth_at(line, t_out));
        bool is_in_front = is_nearer(farthest, surface);
        if (!is_in_front && level > 0) {
            --level;
            continue;
        }
        if (!is_in_front) {
            March end = meet(line, here.pixel, surface, here.t, t_out, farthest);
            if (end.is_hit) return end;
        }
        here = ahead;
        if (is_in_front) level = min(level + 1, coarsest);
    }
    return miss;
}
#endif
