// A ray as a straight line through the samples of the G-buffer. Position and device depth are affine along it, so that
// the walk needs no division per step.
#ifndef FROSTBITE_SSSR_SCREEN_LINE_GLSL
#define FROSTBITE_SSSR_SCREEN_LINE_GLSL
#include "common/mirror_ray.glsl"

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
const float slowest = 1e-20;

float t_of_depth(ScreenLine line, float device_depth) { return (device_depth - line.origin.z) / line.slope.z; }
float depth_at(ScreenLine line, float t) { return line.origin.z + t * line.slope.z; }

// Distance along the ray (m).
float distance_at(ScreenLine line, float t) { return t * line.w / (line.rate - t * line.w_rate); }

float end_of(ScreenLine line) {
    vec2 border = mix(vec2(0.0), camera.extent.xy, greaterThan(line.slope.xy, vec2(0.0)));
    vec2 t_border = (border - line.origin.xy) * line.inverse;
    float end = min(t_border.x, t_border.y);
    // The near plane, behind which nothing can be projected, or the far plane, beyond which nothing is drawn.
    return line.slope.z == 0.0 ? end : min(end, t_of_depth(line, line.slope.z > 0.0 ? 1.0 : 0.0));
}

// `direction`: view space, unit. The line is the tangent of the projected ray at its origin, which no point behind the
// camera can turn round.
ScreenLine screen_line(ivec2 pixel, vec3 vs_origin, vec3 direction, vec3 vs_normal) {
    vec4 from = camera.clip_from_view * vec4(vs_origin, 1.0), per_meter = camera.clip_from_view * vec4(direction, 0.0);
    vec3 tangent = per_meter.xyz - from.xyz / from.w * per_meter.w;
    tangent.xy *= 0.5 * camera.extent.xy;

    ScreenLine line;
    line.pixel = pixel;
    line.origin = vec3(vec2(pixel) + 0.5, texelFetch(depth, pixel, 0).r);
    line.rate = max(max(abs(tangent.x), abs(tangent.y)), slowest);
    line.slope = tangent / line.rate;
    line.slope.xy = mix(line.slope.xy, vec2(slowest), lessThan(abs(line.slope.xy), vec2(slowest)));
    line.inverse = 1.0 / line.slope.xy;
    line.end = end_of(line);
    line.w = from.w;
    line.w_rate = per_meter.w;
    line.vs_origin = vs_origin;
    line.vs_normal = vs_normal;
    line.rise = dot(direction, vs_normal);
    return line;
}
#endif
