// The march through the depth pyramid: a ray goes from texel to texel of the level that it is on, a level coarser after
// each texel that it crossed above the surface, a level finer where it would pass below.
#ifndef AMD_SSSR_MARCH_GLSL
#define AMD_SSSR_MARCH_GLSL
#include "amd_sssr/screen.glsl"

const uint as_in_sdk = 0u;             // parameter `march`
const float huge = 3.402823466e38;     // largest float
const float overshoot_texels = 0.005;  // of the finest level: beyond a border, lest rounding fall short of it

struct MarchEnd {
    vec3 position;       // image
    bool is_unfinished;  // given up before it met anything
};

// A straight line on the screen, whose t is not proportional to distance. Its direction is that of a step of one metre.
struct ScreenRay {
    vec3 origin, direction, inverse;
};

vec3 inverse_of(vec3 direction) {
    // The original compares whole vectors: a single zero passes, and infinities meet in the products below.
    return direction != vec3(0.0) ? 1.0 / direction : vec3(huge);
}

// A step that ends behind the camera would be projected to the opposite side of the screen.
float step_before_near_plane(vec3 origin, vec3 direction) {
    float reach = -camera.depth.x - origin.z;  // to the near plane
    return direction.z > 0.0 ? min(1.0, 0.99 * max(reach, 0.0) / direction.z) : 1.0;
}

ScreenRay screen_ray(vec3 image_origin, vec3 vs_origin, vec3 vs_direction) {
    float step = clip_ray_to_near_plane ? step_before_near_plane(vs_origin, vs_direction) : 1.0;
    vec3 direction = image_from_view(vs_origin + step * vs_direction) - image_origin;
    if (guard_zero_direction) direction = mix(direction, vec3(1e-12), lessThan(abs(direction), vec3(1e-12)));
    return ScreenRay(image_origin, direction, inverse_of(direction));
}

// t at which the ray meets three planes: the borders of a texel ahead (x, y), and a depth.
vec3 distance_to_planes(ScreenRay ray, vec3 planes) {
    return march == as_in_sdk ? planes * ray.inverse - ray.origin * ray.inverse : (planes - ray.origin) * ray.inverse;
}

bool are_same(float a, float b) { return march == as_in_sdk ? floatBitsToUint(a) == floatBitsToUint(b) : a == b; }

// True for all rays of a subgroup when few of them are left.
bool gives_up() {
    return min_traversal_occupancy > 0u && subgroupBallotBitCount(subgroupBallot(true)) <= min_traversal_occupancy;
}

bool is_outside(vec2 uv) { return any(lessThan(uv, vec2(0.0))) || any(greaterThanEqual(uv, vec2(1.0))); }

// `finest`: level of the pyramid at which a surface counts as met.
MarchEnd march_pyramid(ScreenRay ray, int finest, bool is_mirror) {
    int coarsest = textureQueryLevels(depth_pyramid) - 1;
    vec2 resolution = camera.extent.xy / float(1 << finest);  // of the level, not rounded
    bvec2 is_negative = lessThan(ray.direction.xy, vec2(0.0));
    vec2 border = mix(vec2(1.0), vec2(0.0), is_negative);  // of a texel, that lies ahead
    vec2 overshoot = mix(vec2(1.0), vec2(-1.0), is_negative) * overshoot_texels / resolution;
    bool recedes = is_farther(ray.direction.z, 0.0);

    // To the first border, without a look at the texel of the origin.
    vec2 ahead = (floor(resolution * ray.origin.xy) + border) / resolution + overshoot;
    vec2 t_first = distance_to_planes(ray, vec3(ahead, 0.0)).xy;
    float t = min(t_first.x, t_first.y);
    vec3 position = ray.origin + t * ray.direction;

    int level = finest;
    uint step = 0u;
    bool has_given_up = false;
    while (step < max_traversal_intersections && level >= finest && !has_given_up) {
        if (stop_outside_screen && is_outside(position.xy)) return MarchEnd(position, true);
        vec2 texel = resolution * position.xy;
        float surface = surface_depth(ivec2(texel), level);
        has_given_up = gives_up() && !is_mirror;

        vec3 planes = vec3((floor(texel) + border) / resolution + overshoot, surface);
        vec3 t_planes = distance_to_planes(ray, planes);
        if (!recedes) t_planes.z = huge;
        float t_nearest = min(min(t_planes.x, t_planes.y), t_planes.z);
        bool is_above = is_farther(surface, position.z);
        bool skips = is_above && !are_same(t_nearest, t_planes.z);
        if (is_above) t = t_nearest;
        position = ray.origin + t * ray.direction;
        if (!skips) {
            --level;
            resolution *= 2.0;
        } else if (level < coarsest) {
            ++level;
            resolution *= 0.5;
        }
        ++step;
    }
    return MarchEnd(position, level >= finest);
}
#endif
