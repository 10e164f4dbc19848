// A ray as a straight line through the samples of the G-buffer. Position and device depth are affine along it, so that
// the walk needs no division per step.
#ifndef TRACERS_SCREEN_LINE_GLSL
#define TRACERS_SCREEN_LINE_GLSL
#include "tracers/own_plane.glsl"
#include "tracers/trace.glsl"

struct ScreenLine {
    ivec2 pixel;          // that it starts from
    vec3 origin, slope;   // x, y (pixels) and device depth at t = 0 and per t, which is a pixel of the major axis
    vec2 inverse;         // 1 / slope.xy
    float end;            // t at which it leaves the screen or the camera's range of depths
    float w, w_rate;      // homogeneous coordinate of the origin, and its growth (1 / m)
    float rate;           // pixels of the major axis per m, times w
    vec3 vs_origin, vs_normal;  // the surface that it leaves (view space, geometric)
    float rise;           // m off that surface per m along the ray
};

// Slope of lines that keep to a row or column: they meet its walls too late to matter.
const float slowest_slope = 1e-20;

float t_of_depth(ScreenLine line, float device_depth) { return (device_depth - line.origin.z) / line.slope.z; }
float depth_at(ScreenLine line, float t) { return line.origin.z + t * line.slope.z; }

// Distance along the ray (m).
float distance_at(ScreenLine line, float t) { return t * line.w / (line.rate - t * line.w_rate); }

// t at a distance along the ray (m); none of the camera's side is that far if it passes the camera plane before.
float t_of_distance(ScreenLine line, float distance) {
    float w = line.w + distance * line.w_rate;
    return w > 0.0 ? distance * line.rate / w : 3.402823466e38;
}

// The place between two t that comes nearest to the depth of a surface.
float closest_t(ScreenLine line, float surface, float t_in, float t_out) {
    return line.slope.z == 0.0 ? t_in : clamp(t_of_depth(line, surface), t_in, t_out);
}

float end_of_line(ScreenLine line) {
    vec2 border = mix(vec2(0.0), camera.extent.xy, greaterThan(line.slope.xy, vec2(0.0)));
    vec2 t_border = (border - line.origin.xy) * line.inverse;
    float end = min(t_border.x, t_border.y);
    // The near plane, behind which nothing can be projected, or the far plane, beyond which nothing is drawn.
    return line.slope.z == 0.0 ? end : min(end, t_of_depth(line, line.slope.z > 0.0 ? 1.0 : 0.0));
}

// The line is the tangent of the projected ray at its origin, which no point behind the camera can turn round.
ScreenLine screen_line(TraceRay ray) {
    vec4 from = camera.clip_from_view * vec4(ray.origin, 1.0),
         per_meter = camera.clip_from_view * vec4(ray.direction, 0.0);
    vec3 tangent = per_meter.xyz - from.xyz / from.w * per_meter.w;
    tangent.xy *= 0.5 * camera.extent.xy;

    ScreenLine line;
    line.pixel = ray.pixel;
    line.origin = vec3(vec2(ray.pixel) + 0.5, fetch_depth(ray.pixel));
    line.rate = max(max(abs(tangent.x), abs(tangent.y)), slowest_slope);
    line.slope = tangent / line.rate;
    line.slope.xy = mix(line.slope.xy, vec2(slowest_slope), lessThan(abs(line.slope.xy), vec2(slowest_slope)));
    line.inverse = 1.0 / line.slope.xy;
    line.end = end_of_line(line);
    line.w = from.w;
    line.w_rate = per_meter.w;
    line.vs_origin = ray.origin;
    line.vs_normal = ray.geometric_normal;
    line.rise = dot(ray.direction, ray.geometric_normal);
    return line;
}

// The line from the origin to the projection of the ray's point at `distance` (m), as it comes out where nobody looks
// whether that lies behind the camera: turned round then, to where the ray never goes.
ScreenLine line_to_unclipped_end(ScreenLine line, float distance) {
    if (line.w + distance * line.w_rate > 0.0) return line;
    line.slope = -line.slope;
    line.inverse = -line.inverse;
    line.rate = -line.rate;
    line.end = end_of_line(line);
    return line;
}

// Ends the line where the ray has this length (m).
void shorten_line(inout ScreenLine line, float distance) { line.end = min(line.end, t_of_distance(line, distance)); }

// On the un-jittered screen (pixels).
vec2 position_at(ScreenLine line, float t) { return line.origin.xy + t * line.slope.xy + camera.jitter.xy; }
ivec2 pixel_at(ScreenLine line, float t) {
    return clamp(ivec2(floor(line.origin.xy + t * line.slope.xy)), ivec2(0), ivec2(camera.extent.xy) - 1);
}

// Whether what `pixel` shows at the device depth `surface` is of the plane that the ray leaves; the ray passes it at t.
bool is_own_plane_at(ScreenLine line, ivec2 pixel, float surface, float t) {
    vec3 from_origin = view_position_at(pixel, surface) - line.vs_origin;
    return is_own_plane(from_origin, line.vs_normal, line.rise, distance_at(line, t));
}

// Of a ray that came to the end of its line, or of as many steps as it may take.
TraceEnd missed_on_line(ScreenLine line, bool is_unfinished) {
    vec2 place = line.origin.xy + line.end * line.slope.xy;
    bool is_at_border = any(lessThan(min(place, camera.extent.xy - place), vec2(0.01)));
    bool comes_nearer = is_nearer(line.slope.z, 0.0);
    uint outcome = is_unfinished  ? outcome_unfinished
                   : is_at_border ? outcome_off_screen
                   : comes_nearer ? outcome_behind_camera
                                  : outcome_background;
    return missed(outcome, place + camera.jitter.xy, max(distance_at(line, line.end), 0.0));
}
#endif
