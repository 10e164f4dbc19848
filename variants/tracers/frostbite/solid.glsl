// What a ray meets within a pixel: the surface that the pixel shows and an assumed thickness behind it,
// `frostbite.relative_thickness`.
#ifndef TRACERS_FROSTBITE_SOLID_GLSL
#define TRACERS_FROSTBITE_SOLID_GLSL
#include "tracers/screen_line.glsl"

// Where a march ended.
struct FrostbiteEnd {
    bool is_hit;
    ivec2 pixel;
    float t;
};

const FrostbiteEnd frostbite_no_hit = FrostbiteEnd(false, ivec2(0), 0.0);

// Whether all of a line that comes no nearer than a device depth is behind what counts as solid of a surface.
bool frostbite_is_behind_solid(float nearest, float surface) {
    return view_z(nearest) < view_z(surface) * (1.0 + frostbite_relative_thickness);
}

// The part of the line from t_in to t_out, whose device depth there comes to `farthest` at most, against what `pixel`
// shows. `surface`: its device depth.
FrostbiteEnd frostbite_meet(ScreenLine line, ivec2 pixel, float surface, float t_in, float t_out, float farthest) {
    if (is_background(surface) || is_nearer(farthest, surface)) return frostbite_no_hit;
    float nearest = nearer_of(depth_at(line, t_in), depth_at(line, t_out));
    if (frostbite_is_behind_solid(nearest, surface)) return frostbite_no_hit;
    float t = closest_t(line, surface, t_in, t_out);
    bool is_own = frostbite_leave_own_plane && is_own_plane_at(line, pixel, surface, t);
    return FrostbiteEnd(!is_own, pixel, t);
}

// Behind what it shows from the other side, the screen knows of nothing that the ray could go on to.
TraceEnd frostbite_end(ScreenLine line, FrostbiteEnd end, TraceRay ray, bool is_unfinished) {
    if (!end.is_hit) return missed_on_line(line, is_unfinished);
    vec2 position = position_at(line, end.t);
    float ray_length = distance_at(line, end.t);
    if (frostbite_front_faces_only && comes_from_behind(ray.direction, end.pixel))
        return missed(outcome_from_behind, position, ray_length);
    return TraceEnd(end.pixel, position, ray_length, 1.0, outcome_hit);
}
#endif
