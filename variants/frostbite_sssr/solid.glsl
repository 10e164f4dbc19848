// What a ray meets within a pixel: the surface that the pixel shows and, for want of knowledge, as much behind it as
// `relative_thickness` says.
#ifndef FROSTBITE_SSSR_SOLID_GLSL
#define FROSTBITE_SSSR_SOLID_GLSL
#include "frostbite_sssr/screen_line.glsl"

// Where a march ended.
struct March {
    bool is_hit;
    ivec2 pixel;
    float t;
};

const March miss = March(false, ivec2(0), 0.0);

bool is_nearer(float a, float b) { return camera.depth.w == 1.0 ? a > b : a < b; }
float nearer_of(float a, float b) { return is_nearer(a, b) ? a : b; }
float farther_of(float a, float b) { return is_nearer(a, b) ? b : a; }

// Whether all of a line that comes no nearer than a device depth is behind what counts as solid of a surface.
bool is_behind_solid(float nearest, float surface) { return view_z(nearest) < view_z(surface) * (1.0 + relative_thickness); }

// Of the plane that the ray leaves, and so not what it meets.
bool is_own_plane(ScreenLine line, ivec2 pixel, float t) {
    float height = dot(view_position(pixel) - line.vs_origin, line.vs_normal);
    return height < 0.5 * line.rise * distance_at(line, t);
}

// The place between two t that comes nearest to the depth of a surface.
float closest_t(ScreenLine line, float surface, float t_in, float t_out) {
    return line.slope.z == 0.0 ? t_in : clamp(t_of_depth(line, surface), t_in, t_out);
}

// The part of the line from t_in to t_out, whose device depth there comes to `farthest` at most, against what `pixel`
// shows. `surface`: its device depth.
March meet(ScreenLine line, ivec2 pixel, float surface, float t_in, float t_out, float farthest) {
    if (is_background(surface) || is_nearer(farthest, surface)) return miss;
    float nearest = nearer_of(depth_at(line, t_in), depth_at(line, t_out));
    if (is_behind_solid(nearest, surface)) return miss;
    float t = closest_t(line, surface, t_in, t_out);
    return leave_own_plane && is_own_plane(line, pixel, t) ? miss : March(true, pixel, t);
}
#endif
