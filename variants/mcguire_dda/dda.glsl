// McGuire & Mara 2014, "Efficient GPU Screen-Space Ray Tracing", JCGT 3(4), section 3: a ray is walked along its line
// on the screen, one pixel (or `stride` pixels) of the line's major axis at a time. View-space position times 1/w, and
// 1/w, are affine along that line, so the ray's depth at a pixel costs one division.
#ifndef MCGUIRE_DDA_GLSL
#define MCGUIRE_DDA_GLSL
#include "common/mirror_ray.glsl"

struct DdaHit {
    vec2 position;   // on the un-jittered screen (pixels)
    float distance;  // along the ray (m)
    bool is_hit;
};

// A point of the line: position on the screen (pixels), view-space position / w, 1 / w.
struct LinePoint {
    vec2 p;
    vec3 q;
    float k;
};

LinePoint project_to_line(vec3 vs_position) {
    vec4 clip = camera.clip_from_view * vec4(vs_position, 1.0);
    float k = 1.0 / clip.w;
    return LinePoint((clip.xy * k * 0.5 + 0.5) * camera.extent.xy, vs_position * k, k);
}

LinePoint mix_points(LinePoint a, LinePoint b, float t) {
    return LinePoint(mix(a.p, b.p, t), mix(a.q, b.q, t), mix(a.k, b.k, t));
}

// Far end of the ray: `max_distance` away, or where it meets the near plane, behind which nothing can be projected.
vec3 clip_to_near_plane(Ray ray) {
    float reach = max_distance > 0.0 ? max_distance : 2.0 * camera.depth.y;
    float near_z = -camera.depth.x;
    if (ray.origin.z + ray.direction.z * reach > near_z) reach = max((near_z - ray.origin.z) / ray.direction.z, 0.0);
    return ray.origin + ray.direction * reach;
}

// The share of the line from b back to a that lies outside of the screen. A hundredth of a pixel is passed over: a line that
// runs along the border, from the centre of a pixel there, is outside by rounding alone, and all of it.
float outside_share(vec2 a, vec2 b) {
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

// Depth behind the visible surface that counts as solid (m).
float solid_depth(float scene_z) { return thickness + relative_thickness * -scene_z; }

// Deviation: where nothing was drawn there is nothing to hit. The paper compares with the far plane there.
// `is_thick`: whatever is behind the surface counts.
bool meets(ivec2 pixel, float z_min, float z_max, bool is_thick) {
    float device_depth = texelFetch(depth, pixel, 0).r;
    if (is_background(device_depth)) return false;
    float scene_z = view_z(device_depth);
    return z_min <= scene_z && (is_thick || z_max >= scene_z - solid_depth(scene_z));
}

struct Line {
    LinePoint start, step;  // step: per pixel of the major axis
    float pixels;           // its length along the major axis
};

Line make_line(Ray ray) {
    LinePoint a = project_to_line(ray.origin), b = project_to_line(clip_to_near_plane(ray));
    if (clip_to_viewport) b = mix_points(b, a, outside_share(a.p, b.p));
    // A ray along the view is a point on the screen. Its line is given some direction; with the first step a stride
    // away it then meets nothing, which is right: all that its pixel shows is its origin.
    if (dot(b.p - a.p, b.p - a.p) < 1e-4) b.p = a.p + 0.01;
    vec2 extent = abs(b.p - a.p);
    float pixels = max(extent.x, extent.y);
    return Line(a, LinePoint((b.p - a.p) / pixels, (b.q - a.q) / pixels, (b.k - a.k) / pixels), pixels);
}

// Deviation: points are taken at start + t * step, where the paper adds up steps: the same points, fewer roundings.
vec2 position_at(Line line, float t) { return line.start.p + line.step.p * t; }
vec3 view_position_at(Line line, float t) {
    return (line.start.q + line.step.q * t) / (line.start.k + line.step.k * t);
}
// Clamped to the line as in the authors' later G3D version: the look-ahead of half a step would leave the segment, and
// behind its end 1/w may change its sign.
float z_at(Line line, float t) { return view_position_at(line, min(t, line.pixels)).z; }

DdaHit hit_at(Line line, float t, Ray ray) {
    return DdaHit(position_at(line, t), length(view_position_at(line, min(t, line.pixels)) - ray.origin), true);
}

// G3D's refinement for stride > 1: back up by one stride, walk single pixels, take the first where the ray is behind.
float refine_hit(Line line, float t_hit) {
    float t = max(t_hit - float(stride), 0.0);
    uint limit = uint(1.4 * float(stride));
    for (uint i = 0u; i < limit; ++i) {
        t += 1.0;
        if (t >= t_hit) break;
        ivec2 pixel = pixel_from_screen(position_at(line, t));
        float z = z_at(line, t + 0.5);
        if (is_on_screen(pixel) && meets(pixel, z, z, true)) return t;
    }
    return t_hit;
}

DdaHit march(Ray ray, float start) {
    Line line = make_line(ray);
    // Deviation, unless `interval_from_origin`: the first tested pixel is a voxel of half a step to both sides, as all.
    float z_before = interval_from_origin ? ray.origin.z : z_at(line, max(start - 0.5, 0.0) * float(stride));
    for (uint i = 0u; i < max_steps; ++i) {
        float t = float(stride) * (start + float(i));
        if (t > line.pixels) break;
        // Deviation: floor and a bounds test; truncation would let rays up to a pixel off the screen hit its border.
        ivec2 pixel = pixel_from_screen(position_at(line, t));
        if (!is_on_screen(pixel)) break;
        float z_after = z_at(line, t + 0.5 * float(stride));
        if (meets(pixel, min(z_before, z_after), max(z_before, z_after), false)) {
            // Deviation: the hit is at the pixel tested. The loop as printed has moved one stride further by then.
            return hit_at(line, refine && stride > 1u ? refine_hit(line, t) : t, ray);
        }
        z_before = z_after;
    }
    return DdaHit(vec2(0.0), 0.0, false);
}
#endif
