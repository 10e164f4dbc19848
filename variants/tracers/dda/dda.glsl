// McGuire & Mara 2014, "Efficient GPU Screen-Space Ray Tracing", JCGT 3(4), section 3: a ray is walked along its line
// on the screen, one pixel (or `stride` pixels) of the line's major axis at a time. View-space position times 1/w, and
// 1/w, are affine along that line, so the ray's depth at a pixel costs one division.
#ifndef TRACERS_DDA_GLSL
#define TRACERS_DDA_GLSL
#include "tracers/stride.glsl"
#include "tracers/trace.glsl"

#ifdef TRACER_HAS_DEPTH_LAYERS
uniform sampler2D second_depth;
#endif

// A point of the line: position on the screen (pixels), view-space position / w, 1 / w.
struct DdaPoint {
    vec2 p;
    vec3 q;
    float k;
};

DdaPoint dda_project(vec3 vs_position) {
    vec4 clip = camera.clip_from_view * vec4(vs_position, 1.0);
    float k = 1.0 / clip.w;
    return DdaPoint((clip.xy * k * 0.5 + 0.5) * camera.extent.xy, vs_position * k, k);
}

DdaPoint dda_mix(DdaPoint a, DdaPoint b, float t) {
    return DdaPoint(mix(a.p, b.p, t), mix(a.q, b.q, t), mix(a.k, b.k, t));
}

// Far end of the ray: `max_distance` away, or where it meets the near plane, behind which nothing can be projected.
vec3 dda_far_end(TraceRay ray) {
    float reach = reach_of(dda_max_distance);
    float near_z = -camera.depth.x;
    if (ray.origin.z + ray.direction.z * reach > near_z) reach = max((near_z - ray.origin.z) / ray.direction.z, 0.0);
    return ray.origin + ray.direction * reach;
}

// The share of the line from b back to a that lies outside of the screen. A hundredth of a pixel is passed over: a line that
// runs along the border, from the centre of a pixel there, is outside by rounding alone, and all of it.
float dda_outside_share(vec2 a, vec2 b) {
    const float rounding = 0.01;
    vec2 low = vec2(0.5), high = camera.extent.xy - 0.5;
    float share = 0.0;
    for (int axis = 0; axis < 2; ++axis) {
        float bound = b[axis] > high[axis] ? high[axis] : b[axis] < low[axis] ? low[axis] : b[axis];
        // An origin in the outermost half pixel of a jittered G-buffer may lie outside too: the line is empty then.
        if (abs(b[axis] - bound) > rounding) share = max(share, min((b[axis] - bound) / (b[axis] - a[axis]), 1.0));
    }
    return share;
}

// Whether a ray that comes to these depths within a pixel is within what counts as solid of a surface there.
// Deviation: where nothing was drawn there is nothing to hit. The paper compares with the far plane there.
bool dda_meets(float device_depth, float z_min, float z_max) {
    if (is_background(device_depth)) return false;
    float scene_z = view_z(device_depth);
    return z_min <= scene_z && z_max >= scene_z - solid_depth(scene_z, dda_thickness, dda_relative_thickness);
}

struct DdaLine {
    DdaPoint start, step;  // step: per pixel of the major axis
    float pixels;          // its length along the major axis
    float stride;          // pixels of the major axis
    uint end_outcome;      // of a ray that comes to the line's end
};

DdaLine dda_line(TraceRay ray) {
    vec3 far_end = dda_far_end(ray);
    DdaPoint a = dda_project(ray.origin), b = dda_project(far_end);
    uint end_outcome = far_end.z >= -1.0001 * camera.depth.x ? outcome_behind_camera
                       : dda_max_distance > 0.0              ? outcome_unfinished
                                                             : outcome_background;
    if (dda_clip_to_viewport) {
        float share = dda_outside_share(a.p, b.p);
        b = dda_mix(b, a, share);
        if (share > 0.0) end_outcome = outcome_off_screen;
    }
    // A ray along the view is a point on the screen. Its line is given some direction; with the first step a stride
    // away it then meets nothing, which is right: all that its pixel shows is its origin.
    if (dot(b.p - a.p, b.p - a.p) < 1e-4) b.p = a.p + 0.01;
    vec2 extent = abs(b.p - a.p);
    float pixels = max(extent.x, extent.y);
    return DdaLine(a, DdaPoint((b.p - a.p) / pixels, (b.q - a.q) / pixels, (b.k - a.k) / pixels), pixels,
                   stride_at(ray.origin.z, float(dda_stride), dda_stride_z_cutoff), end_outcome);
}

// Deviation: points are taken at start + t * step, where the paper adds up steps: the same points, fewer roundings.
vec2 dda_position_at(DdaLine line, float t) { return line.start.p + line.step.p * t; }
vec3 dda_view_position_at(DdaLine line, float t) {
    return (line.start.q + line.step.q * t) / (line.start.k + line.step.k * t);
}
// Clamped to the line as in the authors' later G3D version: the look-ahead of half a step would leave the segment, and
// behind its end 1/w may change its sign.
float dda_z_at(DdaLine line, float t) { return dda_view_position_at(line, min(t, line.pixels)).z; }
float dda_distance_at(DdaLine line, float t, TraceRay ray) {
    return length(dda_view_position_at(line, min(t, line.pixels)) - ray.origin);
}

// G3D's refinement for strides above 1: back up by one stride, walk single pixels, take the first that the ray is behind.
float dda_refined(DdaLine line, float t_hit) {
    float t = max(t_hit - line.stride, 0.0);
    uint limit = uint(1.4 * line.stride);
    for (uint i = 0u; i < limit; ++i) {
        t += 1.0;
        if (t >= t_hit) break;
        ivec2 pixel = pixel_from_screen(dda_position_at(line, t));
        float z = dda_z_at(line, t + 0.5);
        if (!is_on_screen(pixel)) continue;
        float device_depth = fetch_depth(pixel);
        if (!is_background(device_depth) && z <= view_z(device_depth)) return t;
    }
    return t_hit;
}

// Where the first tested pixel lies (strides).
float dda_start(ivec2 pixel) {
    return dda_checkerboard && ((pixel.x + pixel.y) & 1) == 1 ? dda_jitter + 0.5 : dda_jitter;
}

// Deviation: of the second layer the G-buffer keeps no colour, so that it ends rays in place of being shown.
bool dda_meets_second_layer(ivec2 pixel, float z_min, float z_max) {
#ifdef TRACER_HAS_DEPTH_LAYERS
    count_fetch();
    return dda_layers == 1u && dda_meets(texelFetch(second_depth, pixel, 0).r, z_min, z_max);
#else
    return false;
#endif
}

const uint dda_goes_on = 0xffffffffu;  // no outcome yet
const uint dda_batch = 4u;             // steps

// The step that tests `pixel`, which shows `device_depth` if it is on the screen. Its outcome, or dda_goes_on.
uint dda_step(DdaLine line, float t, ivec2 pixel, float device_depth, inout float z_before) {
    if (t > line.pixels) return line.end_outcome;
    if (!is_on_screen(pixel)) return outcome_off_screen;
    count_fetch();
    float z_after = dda_z_at(line, t + 0.5 * line.stride);
    float z_min = min(z_before, z_after), z_max = max(z_before, z_after);
    z_before = z_after;
    if (dda_meets(device_depth, z_min, z_max)) return outcome_hit;
    return dda_meets_second_layer(pixel, z_min, z_max) ? outcome_hidden : dda_goes_on;
}

// Of the nearest pixel on the screen; not by count_fetch(), since a batch may read beyond the ray's end.
float dda_depth_at(ivec2 pixel) {
    return texelFetch(depth, clamp(pixel, ivec2(0), ivec2(camera.extent.xy) - 1), 0).r;
}

TraceEnd dda_trace(TraceRay ray) {
    DdaLine line = dda_line(ray);
    float start = dda_start(ray.pixel);
    // Deviation, unless `interval_from_origin`: the first tested pixel is a voxel of half a step to both sides, as all.
    float z_before = dda_interval_from_origin ? ray.origin.z : dda_z_at(line, max(start - 0.5, 0.0) * line.stride);
    // Steps in batches, which wait for their depths together. What only a hit needs comes after the loop: where both sides
    // of a branch are run, each step would pay for it.
    uint outcome = dda_goes_on;
    float t = 0.0;
    for (uint i = 0u; i < dda_max_steps && outcome == dda_goes_on; i += dda_batch) {
        float t_of[dda_batch], depth_of[dda_batch];
        ivec2 pixel_of[dda_batch];
        for (uint k = 0u; k < dda_batch; ++k) {
            t_of[k] = line.stride * (start + float(i + k));
            // Deviation: floor and a bounds test; truncation would let rays up to a pixel off the screen hit its border.
            pixel_of[k] = pixel_from_screen(dda_position_at(line, t_of[k]));
            depth_of[k] = dda_depth_at(pixel_of[k]);
        }
        for (uint k = 0u; k < dda_batch; ++k)
            if (outcome == dda_goes_on && i + k < dda_max_steps) {
                t = t_of[k];
                outcome = dda_step(line, t, pixel_of[k], depth_of[k], z_before);
            }
    }
    if (outcome == dda_goes_on) outcome = outcome_unfinished;
    bool is_hit = outcome == outcome_hit;
    // Deviation: the hit is at the pixel tested. The loop as printed has moved one stride further by then.
    if (is_hit && dda_refine && line.stride > 1.0) t = dda_refined(line, t);
    vec2 position = dda_position_at(line, t);
    float ray_length = dda_distance_at(line, t, ray);
    if (!is_hit) return missed(outcome, position, ray_length);
    return TraceEnd(pixel_from_screen(position), position, ray_length, 1.0, outcome_hit);
}
#endif
