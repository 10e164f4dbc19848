// The march through the depth hierarchy.
#ifndef DILIGENT_SSR_MARCH_GLSL
#define DILIGENT_SSR_MARCH_GLSL
#include "common/hierarchy_walk.glsl"

uniform sampler2D depth_hierarchy;

// The original's unprojection knows of no jitter, though its projection does.
vec3 view_from_march(vec3 position) {
    return unproject_jitter ? view_from_image(position) : view_from_screen(position.xy, position.z);
}

// The nearest surface in a texel of the hierarchy. What a level lacks is 0, as reads beyond an image are in the
// original: the near plane, from which rays descend to the next finer level; but the far plane with reversed depth.
float surface_depth(ivec2 texel, int level) {
    ivec2 extent = ivec2(camera.extent.xy), level_extent = max(extent >> level, ivec2(1));
    if (any(lessThan(texel, ivec2(0)))) return 0.0;
    bool shows_pixels = all(lessThan(texel << level, extent));
    if (clamp_partial_texels && shows_pixels) texel = min(texel, level_extent - 1);
    return all(lessThan(texel, level_extent)) ? texelFetch(depth_hierarchy, texel, level).r : 0.0;
}

// Length (m) of the step that is projected for the ray's direction on the screen. Half the distance from the camera
// plane does not reach that plane, whatever the direction.
float projected_step(vec3 vs_origin, vec3 vs_direction) {
    float step = relative_ray_step ? 0.5 * -vs_origin.z : 1.0;
    return clip_ray_to_near_plane ? step_before_near_plane(vs_origin, vs_direction, step) : step;
}

ScreenRay screen_ray(vec3 image_origin, vec3 vs_origin, vec3 vs_direction) {
    vec3 end = vs_origin + projected_step(vs_origin, vs_direction) * vs_direction;
    vec3 direction = image_from_view(end) - image_origin;
    return ScreenRay(image_origin, direction, mix(1.0 / direction, vec3(huge), equal(direction, vec3(0.0))));
}

vec3 distance_to_planes(ScreenRay ray, vec3 planes) { return planes * ray.inverse - ray.origin * ray.inverse; }
bool are_same(float a, float b) { return floatBitsToUint(a) == floatBitsToUint(b); }

// `finest`, `coarsest`: levels of the hierarchy. A surface counts as met on the finest.
MarchEnd march_hierarchy(ScreenRay ray, int finest, int coarsest) {
    Walk walk = begin_walk(ray, finest);
    for (uint step = 0u; step < max_traversal_intersections && walk.level >= finest; ++step) {
        if (stop_outside_screen && is_outside(walk.position.xy)) return MarchEnd(walk.position, true);
        float surface = surface_depth(ivec2(walk.resolution * walk.position.xy), walk.level);
        walk_on(walk, surface, coarsest);
    }
    return MarchEnd(walk.position, walk.level >= finest);
}
#endif
