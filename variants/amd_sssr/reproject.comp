// AMD FidelityFX Denoiser 1.3 (reflections), first pass, laid out as the original: history and its confidence for every
// glossy pixel, and the average radiance of the tile.
#include "amd_sssr/denoiser_average.glsl"
#include "amd_sssr/denoiser_history.glsl"
#include "amd_sssr/denoiser_shared_halves.glsl"

uniform sampler2D radiance;
uniform writeonly image2D reprojected_radiance, variance, sample_count, average_radiance;

void share_neighborhood(ivec2 pixel, ivec2 local) {
    for (int i = 0; i < 4; ++i) {
        ivec2 block = ivec2(i & 1, i >> 1) * 8;
        share_color(local + block, neighbor_color(texel(radiance, pixel - reach + block).rgb));
    }
}

History reflected_or_surface_history(Surface surface, Neighborhood around) {
    vec2 uv = surface.reflected_uv;
    vec3 found_normal = normal_in_history(uv), surface_normal = normal_in_history(surface.surface_uv);
    float similarity = dot(found_normal, surface.ws_normal);
    float surface_similarity = dot(surface_normal, surface.ws_normal);
    float alpha_change = abs(textureLod(previous_roughness, uv, 0.0).r - surface.alpha);
    float surface_alpha_change = abs(textureLod(previous_roughness, surface.surface_uv, 0.0).r - surface.alpha);
    if (similarity > normal_similarity_threshold && similarity + 1e-3 > surface_similarity &&
        alpha_change < surface_alpha_change + 1e-3)
        return History(uv, textureLod(previous_radiance, uv, 0.0).rgb, sameness_at(surface, uv, found_normal));
    uv = surface.surface_uv;
    vec3 found = textureLod(previous_radiance, uv, 0.0).rgb, difference = found - around.mean;
    // A squared distance against the length of a vector of variances: as in the original.
    bool is_kept = dot(difference, difference) < surface_discard_variance_weight * length(around.variance);
    return History(uv, found, is_kept ? sameness_at(surface, uv, surface_normal) : -1.0);
}

// The best of the 3x3 places around, each step starting from the best so far.
History best_nearby(Surface surface, History history) {
    for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 1; ++x) {
            vec2 uv = history.uv + vec2(x, y) * camera.extent.zw;
            float factor = sameness_at(surface, uv, normal_in_history(uv));
            if (factor > history.factor) {
                history.factor = factor;
                history.uv = uv;
            }
        }
    history.radiance = textureLod(previous_radiance, history.uv, 0.0).rgb;
    return history;
}

// Bilinear filtering again, without the texels that show something else.
History from_same_texels(Surface surface, History history) {
    vec2 position = camera.extent.xy * history.uv - 0.5, share = fract(position + 1.0);
    vec3 radiance_sum = vec3(0.0), normal_sum = vec3(0.0);
    float depth_sum = 0.0, weight_sum = 0.0;
    for (int i = 0; i < 4; ++i) {
        ivec2 corner = ivec2(i & 1, i >> 1), at = ivec2(position) + corner;
        vec3 normal_here = unit_or_zero(texel(previous_normal, at).xyz);
        float depth_here = depth_in_history(history.uv, texel(previous_depth, at).r);
        vec2 weights = mix(1.0 - share, share, vec2(corner));
        bool is_same = sameness(surface, normal_here, depth_here) > 0.5 * disocclusion_threshold;
        float weight = is_same ? weights.x * weights.y : 0.0;
        radiance_sum += weight * texel(previous_radiance, at).rgb;
        normal_sum += weight * normal_here;
        depth_sum += weight * depth_here;
        weight_sum += weight;
    }
    float scale = 1.0 / max(weight_sum, 1e-3);
    return History(history.uv, radiance_sum * scale, sameness(surface, normal_sum * scale, depth_sum * scale));
}

History find_history(Surface surface, Neighborhood around) {
    History history = reflected_or_surface_history(surface, around);
    if (history.factor < 0.0) return history;
    if (history.factor < disocclusion_threshold) history = best_nearby(surface, history);
    if (history.factor < disocclusion_threshold) history = from_same_texels(surface, history);
    return history;
}

bool is_usable(History history) {
    return all(greaterThan(history.uv, vec2(0.0))) && all(lessThan(history.uv, vec2(1.0))) &&
           history.factor >= disocclusion_threshold;
}

// Returns what the pixel adds to its tile's average.
vec3 reproject(ivec2 pixel, float alpha, vec4 color, Neighborhood around) {
    History history = find_history(surface_of(pixel, alpha, color.w), around);
    if (!is_usable(history)) {
        imageStore(reprojected_radiance, pixel, vec4(0.0));
        imageStore(variance, pixel, vec4(1.0));
        imageStore(sample_count, pixel, vec4(1.0));
        return color.rgb;
    }
    float before = textureLod(previous_variance, history.uv, 0.0).r;
    float samples = textureLod(previous_sample_count, history.uv, 0.0).r * history.factor + 1.0;
    samples = min(samples, longest_history(alpha));
    float share_of_before = running_variance ? 1.0 - 1.0 / samples : 1.0 / samples;
    float change = relative_change(color.rgb, history.radiance);
    imageStore(reprojected_radiance, pixel, vec4(history.radiance, 0.0));
    imageStore(variance, pixel, vec4(mix(change, before, share_of_before)));
    imageStore(sample_count, pixel, vec4(samples));
    return mix(color.rgb, history.radiance, average_reprojected_share);
}

void main() {
    ivec2 local = ivec2(gl_LocalInvocationID.xy), pixel = tile_start() + local;
    share_neighborhood(pixel, local);
    barrier();
    float alpha = texel(roughness, pixel).r;
    vec4 color = texel(radiance, pixel);
    vec3 averaged = color.rgb;
    if (is_in_image(pixel) && is_glossy(alpha)) averaged = reproject(pixel, alpha, color, neighborhood_at(local + reach));
    if (barrier_before_average) barrier();

    share_color(local, weighted_for_average(pixel, averaged));
    barrier();
    for (int size = 2; size <= 8; size *= 2) {
        ivec2 near = local * size, far = near + size / 2;
        if (max(far.x, far.y) < 8)
            share_color(near, shared_color_at(near) + shared_color_at(ivec2(far.x, near.y)) +
                                  shared_color_at(ivec2(near.x, far.y)) + shared_color_at(far));
        barrier();
    }
    if (local == ivec2(0)) {
        vec3 average = average_of(shared_color_at(ivec2(0)));
        // With fresh_neighborhood 0 marks tiles that were not listed; this is the least normal r11g11b10f.
        if (fresh_neighborhood) average = max(average, vec3(6.104e-5));
        imageStore(average_radiance, pixel / 8, vec4(average, 0.0));
    }
}
