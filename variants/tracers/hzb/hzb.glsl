// The march of the blog article "Screen Space Ray Reflection", sections 3 and 4, which simplifies FidelityFX SSSR's: in
// uv and device depth, through a pyramid of nearest depths, down to the first surface that the ray falls behind.
#ifndef TRACERS_HZB_GLSL
#define TRACERS_HZB_GLSL
#include "common/depth_pyramid.glsl"
#include "tracers/own_plane.glsl"
#include "tracers/trace.glsl"

const float hzb_huge = 3.402823466e38;     // largest float
const float hzb_overshoot_texels = 0.005;  // beyond a wall, of the base level; section 4.1
const uint hzb_at_coarsest_miss = 0u;      // parameter `at_coarsest`

// A straight line on the screen, whose t is not proportional to distance. Not normalised (section 3).
struct HzbRay {
    vec3 origin, direction, inverse;
    vec2 border;     // of a texel, that lies ahead: 0 or 1
    vec2 overshoot;  // uv
    bool has_plane;  // t of a surface's depth lies ahead of rays in front of it
};

// Length (m) of the step that gives the direction. Half the distance from the camera plane does not reach that plane,
// behind which points are projected to the opposite side; any length before it gives the same line.
float hzb_projected_step(vec3 vs_origin) { return hzb_scale_step ? 0.5 * -vs_origin.z : 1.0; }

HzbRay hzb_ray(TraceRay ray, int base) {
    HzbRay result;
    result.origin = vec3((vec2(ray.pixel) + 0.5) * camera.extent.zw, fetch_depth(ray.pixel));
    vec3 end = ray.origin + hzb_projected_step(ray.origin) * ray.direction;
    vec3 direction = image_from_view(end) - result.origin;
    result.direction = direction;
    result.inverse = 1.0 / direction;
    if (hzb_guard_zero_direction) result.inverse = mix(result.inverse, vec3(hzb_huge), equal(direction, vec3(0.0)));
    bvec2 ascends = greaterThanEqual(direction.xy, vec2(0.0));
    result.border = mix(vec2(0.0), vec2(1.0), ascends);
    vec2 overshoot = hzb_overshoot_texels * exp2(float(base)) * camera.extent.zw;
    result.overshoot = mix(-overshoot, overshoot, ascends);
    result.has_plane = is_farther(direction.z, 0.0) || !hzb_walls_only_towards_camera;
    return result;
}

// Of texels that cover the screen's whole width and height, the fraction of one at its border included.
vec2 hzb_resolution(int level) { return camera.extent.xy * exp2(-float(level)); }

// The nearest surface in a texel. Odd-sized levels lack the last one: read beyond an image, it is 0, which is the far
// plane with reversed depth. The near plane sends the ray down to a level that has it.
float hzb_surface_depth(ivec2 texel, int level) {
    count_fetch();
    ivec2 extent = max(ivec2(camera.extent.xy) >> level, ivec2(1));
    if (all(greaterThanEqual(texel, ivec2(0))) && all(lessThan(texel, extent)))
        return texelFetch(depth_pyramid, texel, level).r;
    return hzb_near_plane_for_partial_texels ? 1.0 - camera.depth.z : 0.0;
}

// t at the walls ahead of the texel that `position` lies in, and at a depth. As printed, which with an infinite
// inverse is no number.
vec3 hzb_distance_to_planes(HzbRay ray, vec3 position, int level, float surface) {
    vec2 resolution = hzb_resolution(level);
    vec2 walls = (floor(resolution * position.xy) + ray.border) / resolution + ray.overshoot;
    return vec3(walls, surface) * ray.inverse - ray.origin * ray.inverse;
}

struct HzbEnd {
    vec3 position;  // image
    uint outcome;   // hit: where it fell behind a surface, or would if it went on
};

// Of a ray that has left the screen, or the camera's range of depths, within the texel before `position`.
HzbEnd hzb_left(HzbRay ray, vec3 position) {
    float near_plane = 1.0 - camera.depth.z;
    if (!is_nearer(position.z, near_plane)) return HzbEnd(position, outcome_off_screen);
    vec3 at_near_plane = ray.origin + (near_plane - ray.origin.z) / ray.direction.z * ray.direction;
    if (is_outside(at_near_plane.xy)) return HzbEnd(position, outcome_off_screen);
    return HzbEnd(at_near_plane, outcome_behind_camera);
}

HzbEnd hzb_walk(HzbRay ray, int base, int coarsest) {
    int level = base;
    vec2 t_first = hzb_distance_to_planes(ray, ray.origin, level, 0.0).xy;
    vec3 position = ray.origin + min(t_first.x, t_first.y) * ray.direction;
    for (uint i = 0u; i < hzb_max_iterations && level >= base; ++i) {
        if (is_outside(position.xy) || is_nearer(position.z, 1.0 - camera.depth.z)) return hzb_left(ray, position);
        float surface = hzb_surface_depth(ivec2(hzb_resolution(level) * position.xy), level);
        vec3 t_planes = hzb_distance_to_planes(ray, position, level, surface);
        if (!ray.has_plane) t_planes.z = hzb_huge;
        float t_walls = min(t_planes.x, t_planes.y);
        bool is_above = is_nearer(position.z, surface), skips = is_above && t_walls < t_planes.z;
        if (is_above) position = ray.origin + min(t_walls, t_planes.z) * ray.direction;
        level += skips ? 1 : -1;
        if (level > coarsest && hzb_at_coarsest == hzb_at_coarsest_miss) return HzbEnd(position, outcome_unfinished);
        level = min(level, coarsest);
    }
    return HzbEnd(position, level < base ? outcome_hit : outcome_unfinished);
}

// What the place where the walk ended is judged as.
uint hzb_judged(TraceRay ray, vec3 position, ivec2 pixel, float distance) {
    float surface = hzb_surface_depth(pixel, 0);
    if (hzb_reject_background && is_background(surface)) return outcome_background;
    if (hzb_reject_own_surface && is_own_surface(ray, pixel, surface, distance)) return outcome_own_surface;
    float scene_z = view_z(surface);
    bool is_close = abs(view_z(position.z) - scene_z) < hzb_relative_thickness * max(abs(scene_z), 1e-5);
    if (!is_close) return outcome_too_thick;
    return hzb_front_faces_only && comes_from_behind(ray.direction, pixel) ? outcome_from_behind : outcome_hit;
}

TraceEnd hzb_trace(TraceRay ray) {
    int coarsest = depth_pyramid_coarsest(hzb_pyramid_mips), base = min(int(hzb_base_level), coarsest);
    HzbEnd end = hzb_walk(hzb_ray(ray, base), base, coarsest);
    float distance = length(view_from_image(end.position) - ray.origin);
    ivec2 pixel = ivec2(camera.extent.xy * end.position.xy);
    if (end.outcome == outcome_hit && is_outside(end.position.xy)) end.outcome = outcome_off_screen;
    if (end.outcome == outcome_hit) end.outcome = hzb_judged(ray, end.position, pixel, distance);
    vec2 position = screen_from_image(end.position.xy);
    if (end.outcome != outcome_hit) return missed(end.outcome, position, distance);
    return TraceEnd(pixel, position, distance, 1.0, outcome_hit);
}
#endif
