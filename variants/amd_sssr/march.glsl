// The march through the depth pyramid.
#ifndef AMD_SSSR_MARCH_GLSL
#define AMD_SSSR_MARCH_GLSL
#include "amd_sssr/screen.glsl"
#include "common/hierarchy_walk.glsl"

const uint as_in_sdk = 0u, not_at_all = 2u;  // parameter `march`

vec3 inverse_of(vec3 direction) {
    // The original compares whole vectors: a single zero passes, and infinities meet in the products below.
    return direction != vec3(0.0) ? 1.0 / direction : vec3(huge);
}

// Its direction is that of a step of one metre.
ScreenRay screen_ray(vec3 image_origin, vec3 vs_origin, vec3 vs_direction) {
    float step = clip_ray_to_near_plane ? step_before_near_plane(vs_origin, vs_direction, 1.0) : 1.0;
    vec3 direction = image_from_view(vs_origin + step * vs_direction) - image_origin;
    if (guard_zero_direction) direction = mix(direction, vec3(1e-12), lessThan(abs(direction), vec3(1e-12)));
    return ScreenRay(image_origin, direction, inverse_of(direction));
}

vec3 distance_to_planes(ScreenRay ray, vec3 planes) {
    return march == as_in_sdk ? planes * ray.inverse - ray.origin * ray.inverse : (planes - ray.origin) * ray.inverse;
}

bool are_same(float a, float b) { return march == as_in_sdk ? floatBitsToUint(a) == floatBitsToUint(b) : a == b; }

// True for all rays of a subgroup when few of them are left.
bool gives_up() {
    return min_traversal_occupancy > 0u && subgroupBallotBitCount(subgroupBallot(true)) <= min_traversal_occupancy;
}

uint steps_taken = 0u;  // of this invocation's march

// `finest`: level of the pyramid at which a surface counts as met.
MarchEnd march_pyramid(ScreenRay ray, int finest, bool is_mirror) {
    if (march == not_at_all) return MarchEnd(ray.origin, true);
    int coarsest = textureQueryLevels(depth_pyramid) - 1;
    Walk walk = begin_walk(ray, finest);
    bool has_given_up = false;
    while (steps_taken < max_traversal_intersections && walk.level >= finest && !has_given_up) {
        if (stop_outside_screen && is_outside(walk.position.xy)) return MarchEnd(walk.position, true);
        float surface = surface_depth(ivec2(walk.resolution * walk.position.xy), walk.level);
        has_given_up = gives_up() && !is_mirror;
        walk_on(walk, surface, coarsest);
        ++steps_taken;
    }
    return MarchEnd(walk.position, walk.level >= finest);
}
#endif
