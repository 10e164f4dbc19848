// The walk of FidelityFX SSSR and of its adaptation in DiligentFX through a pyramid of nearest depths, down to the
// first surface that the ray falls behind. Both then decide whether the ray met that surface.
#ifndef TRACERS_HIERARCHY_GLSL
#define TRACERS_HIERARCHY_GLSL
#include "common/depth_pyramid.glsl"
#include "tracers/hierarchy/walk.glsl"
#include "tracers/trace.glsl"
#ifdef COMPUTE_SHADER
#extension GL_KHR_shader_subgroup_ballot : require
#endif

const uint hierarchy_judgement_amd = 0u;                                          // parameter `judgement`
const uint hierarchy_partial_near_plane = 1u, hierarchy_partial_clamped = 2u;     // parameter `partial_texels`
const uint hierarchy_whole_vector = 0u, hierarchy_nudged = 1u;                    // parameter `zero_direction`

// The nearest surface in a texel of the pyramid. What a level lacks is 0, as reads beyond an image are in the originals:
// the near plane, from which rays descend to the next finer level; but the far plane with reversed depth.
float hierarchy_surface_depth(ivec2 texel, int level) {
    count_fetch();
    ivec2 extent = ivec2(camera.extent.xy), level_extent = max(extent >> level, ivec2(1));
    if (any(lessThan(texel, ivec2(0)))) return 0.0;
    bool shows_pixels = all(lessThan(texel << level, extent));
    if (hierarchy_partial_texels == hierarchy_partial_clamped && shows_pixels) texel = min(texel, level_extent - 1);
    if (all(lessThan(texel, level_extent))) return texelFetch(depth_pyramid, texel, level).r;
    return hierarchy_partial_texels == hierarchy_partial_near_plane && shows_pixels ? 1.0 - camera.depth.z : 0.0;
}

// DiligentFX's unprojection knows of no jitter, though its projection does.
vec3 hierarchy_view_from_image(vec3 position) {
    return hierarchy_unproject_jitter ? view_from_image(position) : view_from_screen(position.xy, position.z);
}

// Length (m) of the step that is projected for the ray's direction on the screen. Half the distance from the camera
// plane does not reach that plane, whatever the direction.
float hierarchy_projected_step(vec3 vs_origin, vec3 vs_direction) {
    float step = hierarchy_relative_ray_step ? 0.5 * -vs_origin.z : 1.0;
    return hierarchy_clip_ray_to_near_plane ? hierarchy_step_before_near_plane(vs_origin, vs_direction, step) : step;
}

HierarchyRay hierarchy_screen_ray(vec3 image_origin, vec3 vs_origin, vec3 vs_direction) {
    vec3 end = vs_origin + hierarchy_projected_step(vs_origin, vs_direction) * vs_direction;
    vec3 direction = image_from_view(end) - image_origin;
    vec3 inverse;
    if (hierarchy_zero_direction <= hierarchy_nudged) {
        if (hierarchy_zero_direction == hierarchy_nudged)
            direction = mix(direction, vec3(1e-12), lessThan(abs(direction), vec3(1e-12)));
        // AMD's original compares whole vectors: a single zero passes, and infinities meet in the products.
        inverse = direction != vec3(0.0) ? 1.0 / direction : vec3(hierarchy_huge);
    } else {
        inverse = mix(1.0 / direction, vec3(hierarchy_huge), equal(direction, vec3(0.0)));
    }
    return HierarchyRay(image_origin, direction, inverse);
}

// True for all rays of a subgroup that get here when they are few.
bool hierarchy_gives_up() {
#ifdef COMPUTE_SHADER
    return hierarchy_min_traversal_occupancy > 0u &&
           subgroupBallotBitCount(subgroupBallot(true)) <= hierarchy_min_traversal_occupancy;
#else
    return false;
#endif
}

struct HierarchyEnd {
    vec3 position;       // image
    bool is_unfinished;  // given up before it met anything
};

// `finest`: level of the pyramid at which a surface counts as met.
HierarchyEnd hierarchy_walk(HierarchyRay ray, int finest, bool is_mirror) {
    if (hierarchy_march == hierarchy_march_none) return HierarchyEnd(ray.origin, true);
    int coarsest = depth_pyramid_coarsest(hierarchy_pyramid_mips);
    HierarchyWalk walk = hierarchy_begin_walk(ray, finest);
    bool has_given_up = false;
    for (uint step = 0u; step < hierarchy_max_traversal_intersections && walk.level >= finest && !has_given_up; ++step) {
        if (hierarchy_stop_outside_screen && is_outside(walk.position.xy)) return HierarchyEnd(walk.position, true);
        float surface = hierarchy_surface_depth(ivec2(walk.resolution * walk.position.xy), walk.level);
        has_given_up = !is_mirror && hierarchy_gives_up();
        hierarchy_walk_on(walk, surface, coarsest);
    }
    return HierarchyEnd(walk.position, walk.level >= finest);
}

bool hierarchy_is_own_pixel(vec2 origin, vec2 hit) {
    if (hierarchy_accept_contact_hits) return ivec2(camera.extent.xy * hit) == ivec2(camera.extent.xy * origin);
    return all(lessThan(abs(hit - origin), 2.0 * camera.extent.zw));
}

struct HierarchyJudgement {
    float confidence;  // share of the hit's colour in the ray's; the rest is whatever is seen by rays that miss
    uint outcome;
};

HierarchyJudgement hierarchy_faded(float miss, float thickness, vec2 hit) {
    float closeness = 1.0 - smoothstep(0.0, thickness, miss);
    float confidence = closeness * closeness;
    if (hierarchy_fade_at_border) confidence *= border_fade(hit);
    // Not above 0 for directions that are not a number, too.
    if (confidence > 0.0) return HierarchyJudgement(confidence, outcome_hit);
    return HierarchyJudgement(0.0, closeness > 0.0 ? outcome_off_screen : outcome_too_thick);
}

// AMD's. The tested depth is of the level that the march ended on, or of the nearest of 2x2 pixels. `vs_ray`: from
// `origin` to `hit`, which are of the image; view space.
HierarchyJudgement hierarchy_judged_by_amd(vec3 origin, vec3 hit, vec3 vs_ray, int finest) {
    if (any(lessThan(hit.xy, vec2(0.0))) || any(greaterThan(hit.xy, vec2(1.0))))
        return HierarchyJudgement(0.0, outcome_off_screen);
    if (hierarchy_is_own_pixel(origin.xy, hit.xy)) return HierarchyJudgement(0.0, outcome_own_surface);
    int level = hierarchy_thickness_at_hit_mip ? finest : 1;
    float surface = hierarchy_surface_depth(ivec2(camera.extent.xy * hit.xy) >> level, level);
    if (is_background(surface)) return HierarchyJudgement(0.0, outcome_background);
    vec3 ws_normal = texelFetch(normal, ivec2(camera.extent.xy * hit.xy), 0).xyz;
    if (dot(mat3(camera.view_from_world) * ws_normal, vs_ray) > 0.0)
        return HierarchyJudgement(0.0, outcome_from_behind);
    float miss = distance(hierarchy_view_from_image(vec3(hit.xy, surface)), hierarchy_view_from_image(hit));
    return hierarchy_faded(miss, hierarchy_depth_buffer_thickness, hit.xy);
}

// DiligentFX's, in shares of the surface's distance from the camera plane. `direction`: view space.
HierarchyJudgement hierarchy_judged_by_diligent(vec3 origin, vec3 hit, vec3 direction) {
    if (is_outside(hit.xy)) return HierarchyJudgement(0.0, outcome_off_screen);
    if (hierarchy_is_own_pixel(origin.xy, hit.xy)) return HierarchyJudgement(0.0, outcome_own_surface);
    ivec2 pixel = ivec2(camera.extent.xy * hit.xy);
    float surface = hierarchy_surface_depth(pixel, 0);
    if (is_far_plane(surface)) return HierarchyJudgement(0.0, outcome_background);
    if (dot(texelFetch(normal, pixel, 0).xyz, mat3(camera.world_from_view) * direction) > 0.0)
        return HierarchyJudgement(0.0, outcome_from_behind);
    vec3 vs_surface = hierarchy_view_from_image(vec3(hit.xy, surface));
    float miss = distance(vs_surface, hierarchy_view_from_image(hit)) / (-vs_surface.z + 5.96e-8);
    return hierarchy_faded(miss, hierarchy_relative_depth_buffer_thickness, hit.xy);
}

// Beyond the far plane positions have no end, and float32 finds some before it. No two points that a camera sees are
// as far apart as four times its far plane's distance, but for views wider than 100 degrees.
float hierarchy_ray_length(vec3 vs_ray) {
    float ray_length = length(vs_ray), most = 4.0 * camera.depth.y;
    return hierarchy_finite_length && !(ray_length <= most) ? most : ray_length;
}

TraceEnd hierarchy_trace(TraceRay ray) {
    int finest = 0;
    if (hierarchy_most_detailed_mip > 0u && !ray.is_mirror)
        finest = min(int(hierarchy_most_detailed_mip), depth_pyramid_coarsest(hierarchy_pyramid_mips));
    vec2 uv = (vec2(ray.pixel) + 0.5) * camera.extent.zw;
    vec3 origin = vec3(uv, 0.0), vs_origin = ray.origin;
    if (finest == 0) {
        origin.z = fetch_depth(ray.pixel);
    } else {
        origin.z = hierarchy_surface_depth(ivec2(uv * camera.extent.xy / float(1 << finest)), finest);
        vs_origin = hierarchy_view_from_image(origin);
    }

    HierarchyEnd end = hierarchy_walk(hierarchy_screen_ray(origin, vs_origin, ray.direction), finest, ray.is_mirror);
    vec3 vs_ray = hierarchy_view_from_image(end.position) - vs_origin;
    vec2 position = screen_from_image(end.position.xy);
    float ray_length = hierarchy_ray_length(vs_ray);
    if (end.is_unfinished && (hierarchy_reject_unfinished || hierarchy_march == hierarchy_march_none))
        return missed(is_outside(end.position.xy) ? outcome_off_screen : outcome_unfinished, position, ray_length);
    HierarchyJudgement judged;  // WebGL 2 has no ?: of structures
    if (hierarchy_judgement == hierarchy_judgement_amd)
        judged = hierarchy_judged_by_amd(origin, end.position, vs_ray, finest);
    else
        judged = hierarchy_judged_by_diligent(origin, end.position, ray.direction);
    if (judged.outcome != outcome_hit) return missed(judged.outcome, position, ray_length);
    return TraceEnd(ivec2(camera.extent.xy * end.position.xy), position, ray_length, judged.confidence, outcome_hit);
}
#endif
