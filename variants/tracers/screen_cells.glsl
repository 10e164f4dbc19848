// The cells of a depth pyramid that a line on the screen crosses. Integers determine them: no rounding can put a line
// on the wrong side of a wall.
#ifndef TRACERS_SCREEN_CELLS_GLSL
#define TRACERS_SCREEN_CELLS_GLSL
#include "tracers/screen_line.glsl"

// Where a line leaves a cell.
struct CellExit {
    float t;
    ivec2 pixel;  // that it enters there
};

// Of the cell of 2^level pixels that `pixel` lies in.
CellExit exit_of_cell(ScreenLine line, ivec2 pixel, int level) {
    ivec2 low = pixel >> level << level, high = low + (1 << level) - 1;
    bvec2 ascends = greaterThan(line.slope.xy, vec2(0.0));
    ivec2 last = low + ivec2(ascends) * (high - low);
    vec2 walls = vec2(last + ivec2(ascends));
    vec2 t_walls = (walls - line.origin.xy) * line.inverse;
    bool is_x = t_walls.x < t_walls.y;
    float t = is_x ? t_walls.x : t_walls.y;
    ivec2 next = ivec2(floor(line.origin.xy + t * line.slope.xy));
    next = clamp(next, min(pixel, last), max(pixel, last));
    if (is_x)
        next.x = ascends.x ? high.x + 1 : low.x - 1;
    else
        next.y = ascends.y ? high.y + 1 : low.y - 1;
    return CellExit(t, next);
}

// Levels leave out the last row or column of odd ones: what they lack is looked at on finer levels. No level has the
// pixels beyond the screen that GPUs run fragment shaders for, to complete quads, and show nothing of.
int existing_level(ivec2 pixel, int level) {
    while (level > 0 && any(greaterThanEqual(pixel >> level, ivec2(camera.extent.xy) >> level))) --level;
    return level;
}
#endif
