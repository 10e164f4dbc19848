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
    ivec2 ascends = ivec2(greaterThan(line.slope.xy, vec2(0.0)));
    ivec2 walls = ((pixel >> level) + ascends) << level, last = walls - ascends;
    vec2 t_walls = (vec2(walls) - line.origin.xy) * line.inverse;
    bool is_x = t_walls.x < t_walls.y;
    float t = is_x ? t_walls.x : t_walls.y;
    ivec2 next = ivec2(line.origin.xy + t * line.slope.xy);
    // Also where rounding left the cell, or a number below 0 was not rounded down.
    next = clamp(next, min(pixel, last), max(pixel, last));
    ivec2 beyond = walls + ascends - 1;
    return CellExit(t, is_x ? ivec2(beyond.x, next.y) : ivec2(next.x, beyond.y));
}

// Levels leave out the last row or column of odd ones: what they lack is looked at on finer levels. No level has the
// pixels beyond the screen that GPUs run fragment shaders for, to complete quads, and show nothing of.
int existing_level(ivec2 pixel, int level) {
    while (level > 0 && any(greaterThanEqual(pixel >> level, ivec2(camera.extent.xy) >> level))) --level;
    return level;
}
#endif
