// Where a pixel's reflection was in the last frame, and whether that history can be trusted.
#ifndef AMD_SSSR_DENOISER_HISTORY_GLSL
#define AMD_SSSR_DENOISER_HISTORY_GLSL
#include "amd_sssr/denoiser_moments.glsl"
#include "amd_sssr/denoiser_tile.glsl"
#include "common/motion.glsl"

uniform sampler2D depth, normal, roughness;
uniform sampler2D previous_radiance, previous_variance, previous_sample_count;
uniform sampler2D previous_depth, previous_normal, previous_roughness;

// A pixel's surface, as history is compared with it.
struct Surface {
    vec3 ws_normal;
    float alpha;
    float history_depth;                // that the surface is expected to have in history (m)
    vec2 surface_uv, reflected_uv;      // in the last frame's images: of the surface; of the point it reflects
    bool may_show_reflected;            // false where that point was behind the camera
};

// A look-up of the last frame.
struct History {
    vec2 uv;
    vec3 radiance;
    float factor;  // 1: the same surface; 0: another one
};

const float history_rejected = -1.0;  // a factor

// The point at `length_of_ray` beyond the surface, on the same line of sight, in the last frame's clip space: a
// plane mirror shows it there (Stachowiak 2015, "Stochastic Screen-Space Reflections", hit point reprojection).
vec4 previous_clip_of_reflected_point(vec3 vs_position, float length_of_ray) {
    vec3 vs_point = vs_position + view_direction(vs_position) * length_of_ray;
    return camera.previous_clip_from_world * (camera.world_from_view * vec4(vs_point, 1.0));
}

Surface surface_of(ivec2 pixel, float alpha, float length_of_ray) {
    vec2 uv = uv_of(pixel), jitter_before = camera.jitter.zw * camera.extent.zw;
    vec3 vs_position = view_from_screen(uv, texel(depth, pixel).r);
    vec4 ws_position = camera.world_from_view * vec4(vs_position, 1.0);
    float depth_before = (camera.previous_view_from_world * ws_position).z;
    vec4 clip = previous_clip_of_reflected_point(vs_position, length_of_ray);
    return Surface(unit_or_zero(texel(normal, pixel).xyz), alpha,
                   abs(reproject_history_depth ? depth_before : vs_position.z),
                   uv - motion_at(pixel) - jitter_before,
                   clip.xy / clip.w * 0.5 + 0.5 - jitter_before, !guard_previous_clip || clip.w > 0.0);
}

float depth_in_history(vec2 uv, float device_depth) {
    if (!reproject_history_depth) return -view_z(device_depth);
    vec4 view = camera.previous_view_from_clip * vec4(uv * 2.0 - 1.0, device_depth, 1.0);
    return abs(view.z / view.w);
}

vec3 normal_in_history(vec2 uv) { return unit_or_zero(textureLod(previous_normal, uv, 0.0).xyz); }

// 1 - how much normal and depth have changed.
float sameness(Surface surface, vec3 ws_normal, float depth_found) {
    float turned = abs(1.0 - max(dot(surface.ws_normal, ws_normal), 0.0));
    float moved = abs(depth_found - surface.history_depth) / surface.history_depth;
    return exp(-disocclusion_normal_weight * turned) * exp(-disocclusion_depth_weight * moved);
}

float sameness_at(Surface surface, vec2 uv, vec3 ws_normal) {
    return sameness(surface, ws_normal, depth_in_history(uv, textureLod(previous_depth, uv, 0.0).r));
}

// A place where history may be found.
struct Candidate {
    vec2 uv;
    vec3 ws_normal;
    float similarity;    // cosine of its normal and the surface's
    float alpha_change;
};

Candidate candidate_at(Surface surface, vec2 uv) {
    vec3 ws_normal = normal_in_history(uv);
    return Candidate(uv, ws_normal, dot(ws_normal, surface.ws_normal),
                     abs(textureLod(previous_roughness, uv, 0.0).r - surface.alpha));
}

bool is_better(Surface surface, Candidate reflected, Candidate on_surface) {
    return surface.may_show_reflected && reflected.similarity > normal_similarity_threshold && reflected.similarity + 1e-3 > on_surface.similarity &&
           reflected.alpha_change < on_surface.alpha_change + 1e-3;
}

// History along the surface's motion must resemble the colours around. A squared distance is held against the length of
// a vector of variances: as in the original.
float squared_distance(vec3 a, vec3 b) { return dot(a - b, a - b); }
bool is_plausible(vec3 found, Neighborhood around) {
    return squared_distance(found, around.mean) < surface_discard_variance_weight * length(around.variance);
}

// Step 0 to 8 of a search through 3x3 places, each starting from the best so far.
void look_nearby(Surface surface, int step_index, inout History history) {
    vec2 uv = history.uv + vec2(step_index % 3 - 1, step_index / 3 - 1) * camera.extent.zw;
    float factor = sameness_at(surface, uv, normal_in_history(uv));
    if (factor > history.factor) {
        history.factor = factor;
        history.uv = uv;
    }
}

// Bilinear filtering without the texels that show something else.
struct SameTexels {
    vec3 radiance, normal;
    float depth, weight;
};

// Corner 0 to 3 of the four texels around `uv`.
void add_texel(Surface surface, vec2 uv, int corner_index, inout SameTexels sum) {
    vec2 position = camera.extent.xy * uv - 0.5, share = fract(position + 1.0);
    ivec2 corner = ivec2(corner_index & 1, corner_index >> 1), at = ivec2(position) + corner;
    vec3 ws_normal = unit_or_zero(texel(previous_normal, at).xyz);
    float depth_here = depth_in_history(uv, texel(previous_depth, at).r);
    vec2 weights = mix(1.0 - share, share, vec2(corner));
    bool is_same = sameness(surface, ws_normal, depth_here) > 0.5 * disocclusion_threshold;
    float weight = is_same ? weights.x * weights.y : 0.0;
    sum.radiance += weight * texel(previous_radiance, at).rgb;
    sum.normal += weight * ws_normal;
    sum.depth += weight * depth_here;
    sum.weight += weight;
}

History history_of(SameTexels sum, Surface surface, vec2 uv) {
    float scale = 1.0 / max(sum.weight, 1e-3);
    return History(uv, sum.radiance * scale, sameness(surface, sum.normal * scale, sum.depth * scale));
}

// Never in the first frame, whose history is black; the original's depth history is 0 then, which matches no surface.
bool is_usable(History history) {
    return reprojection && camera.frame.w == 1u && history.factor >= disocclusion_threshold &&
           all(greaterThan(history.uv, vec2(0.0))) && all(lessThan(history.uv, vec2(1.0)));
}

float longest_history(float alpha) {
    return max(min_history_samples, max_samples * (1.0 - exp(-samples_per_alpha * alpha)));
}
#endif
