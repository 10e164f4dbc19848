// The walk of a ray through a hierarchy of nearest depths, as FidelityFX SSSR and its adaptations take it: from texel
// to texel of the level that it is on, a level coarser after each texel that it crossed above the surface, a level
// finer where it would pass below.
#ifndef TRACERS_HIERARCHY_WALK_GLSL
#define TRACERS_HIERARCHY_WALK_GLSL
#include "common/image_space.glsl"

const float hierarchy_huge = 3.402823466e38;     // largest float
const float hierarchy_overshoot_texels = 0.005;  // of the finest level: beyond a border, lest rounding fall short of it

// A straight line on the screen, whose t is not proportional to distance.
struct HierarchyRay {
    vec3 origin, direction, inverse;
};

struct HierarchyWalk {
    HierarchyRay ray;
    vec2 border;     // of a texel, that lies ahead: 0 or 1
    vec2 overshoot;  // uv
    bool recedes;    // from the camera
    vec3 position;   // image
    vec2 resolution; // of the level, not rounded
    int level;
};

const uint hierarchy_march_sdk = 0u, hierarchy_march_none = 2u;  // parameter `march`

// t at which the ray meets three planes, the borders of a texel ahead (x, y) and a depth.
vec3 hierarchy_distance_to_planes(HierarchyRay ray, vec3 planes) {
    return hierarchy_march == hierarchy_march_sdk ? planes * ray.inverse - ray.origin * ray.inverse
                                                  : (planes - ray.origin) * ray.inverse;
}

bool hierarchy_are_same(float a, float b) {
    return hierarchy_march == hierarchy_march_sdk ? floatBitsToUint(a) == floatBitsToUint(b) : a == b;
}

// The step (m), no longer than that it ends before the near plane: behind the camera it would be projected to the
// opposite side of the screen.
float hierarchy_step_before_near_plane(vec3 vs_origin, vec3 vs_direction, float step) {
    float reach = -camera.depth.x - vs_origin.z;  // to the near plane
    return vs_direction.z > 0.0 ? min(step, 0.99 * max(reach, 0.0) / vs_direction.z) : step;
}

vec2 hierarchy_borders_ahead(HierarchyWalk walk, vec2 texel) {
    return (floor(texel) + walk.border) / walk.resolution + walk.overshoot;
}

// To the first border of the finest level, without a look at the texel of the origin.
HierarchyWalk hierarchy_begin_walk(HierarchyRay ray, int finest) {
    HierarchyWalk walk;
    walk.ray = ray;
    walk.level = finest;
    walk.resolution = camera.extent.xy / float(1 << finest);
    bvec2 is_negative = lessThan(ray.direction.xy, vec2(0.0));
    walk.border = mix(vec2(1.0), vec2(0.0), is_negative);
    walk.overshoot = mix(vec2(1.0), vec2(-1.0), is_negative) * hierarchy_overshoot_texels / walk.resolution;
    walk.recedes = is_farther(ray.direction.z, 0.0);
    vec2 ahead = hierarchy_borders_ahead(walk, walk.resolution * ray.origin.xy);
    vec2 t_first = hierarchy_distance_to_planes(ray, vec3(ahead, 0.0)).xy;
    walk.position = ray.origin + min(t_first.x, t_first.y) * ray.direction;
    return walk;
}

// One step: to the end of the texel, or to its surface, where that is nearer. `surface`: device depth.
void hierarchy_walk_on(inout HierarchyWalk walk, float surface, int coarsest) {
    vec3 planes = vec3(hierarchy_borders_ahead(walk, walk.resolution * walk.position.xy), surface);
    vec3 t_planes = hierarchy_distance_to_planes(walk.ray, planes);
    if (!walk.recedes) t_planes.z = hierarchy_huge;
    float t_nearest = min(min(t_planes.x, t_planes.y), t_planes.z);
    bool is_above = is_farther(surface, walk.position.z);
    bool skips = is_above && !hierarchy_are_same(t_nearest, t_planes.z);
    if (is_above) walk.position = walk.ray.origin + t_nearest * walk.ray.direction;
    if (!skips) {
        --walk.level;
        walk.resolution *= 2.0;
    } else if (walk.level < coarsest) {
        ++walk.level;
        walk.resolution *= 0.5;
    }
}
#endif
