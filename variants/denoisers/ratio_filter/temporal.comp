// Blends each pixel with the previous frame's reflection at two places: where its surface was, and where a mirror
// showed what its rays meet. The place that agrees better with this frame's neighbours counts more.
#include "common/ycocg.glsl"
#include "denoisers/place_before.glsl"
#include "denoisers/ratio_filter/shown.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
uniform sampler2D resolved, resolved_variance, resolved_length, previous_accumulated, previous_accumulated_variance;
uniform writeonly image2D accumulated, accumulated_variance;

struct Neighborhood {
    vec4 mean, deviation;  // of 3x3 pixels, those that reflect
};

// As differences from the pixel, so that equal colours differ by nothing.
Neighborhood neighborhood_of(ivec2 pixel, vec4 center) {
    vec4 sum = vec4(0.0), squares = vec4(0.0);
    float count = 0.0;
    for (int i = 0; i < 9; ++i) {
        ivec2 neighbor = pixel + ivec2(i % 3, i / 3) - 1;
        if (!is_on_screen(neighbor)) continue;
        vec4 shown = texelFetch(resolved, neighbor, 0);
        if (!is_reflection(shown)) continue;
        vec4 difference = ycocg_of(shown) - center;
        sum += difference;
        squares += difference * difference;
        count += 1.0;
    }
    const float least_deviation = 0.25e-4;  // EEVEE: 1e-4 of colours that are four times as large
    vec4 mean = sum / count;
    return Neighborhood(center + mean, max(sqrt(max(squares / count - mean * mean, 0.0)), least_deviation));
}

// Bilinear, over texels that reflected something, not divided by their weights' sum.
struct History {
    vec4 color;
    float variance, weight;
};

History history_at(Place place) {
    History history = History(vec4(0.0), 0.0, 0.0);
    if (!place.is_known) return history;
    vec2 farthest = camera.extent.xy + 0.5;
    bool is_near = all(greaterThanEqual(place.position, vec2(-0.5))) && all(lessThanEqual(place.position, farthest));
    if (!is_near) return history;
    vec2 corner = floor(place.position - 0.5), share = place.position - 0.5 - corner;
    for (int i = 0; i < 4; ++i) {
        ivec2 side = ivec2(i & 1, i >> 1), texel = ivec2(corner) + side;
        vec2 weights = mix(1.0 - share, share, vec2(side));
        float weight = weights.x * weights.y;
        const float least_weight = 1e-6;  // quotients by less say nothing
        if (weight < least_weight || !is_on_screen(texel)) continue;
        vec4 shown = texelFetch(previous_accumulated, texel, 0);
        if (!is_reflection(shown)) continue;
        history.color += weight * shown;
        history.variance += weight * texelFetch(previous_accumulated_variance, texel, 0).r;
        history.weight += weight;
    }
    return history;
}

Place surface_place(ivec2 pixel, vec3 position) {
    if (follow_motion) return Place(surface_before(pixel), true);
    return place_before(vec4(position, 1.0));
}

Place mirror_place(ivec2 pixel, vec3 position) {
    const float miss_length = 1e4;  // m, EEVEE's
    float ray_length = texelFetch(resolved_length, pixel, 0).r;
    if (ray_length == 0.0) ray_length = miss_length;
    vec3 towards_surface = view_direction(position);
    float stretch = exact_mirror_image ? 1.0 : 1.0 / max(-towards_surface.z, 1e-3);
    return place_before(vec4(position + stretch * ray_length * towards_surface, 1.0));
}

// How many powers of two less than a history that is equal to the mean it counts; those refused, `refused`.
const float refused = 1e30;
float unlikeness(History history, Neighborhood around) {
    if (history.weight == 0.0) return refused;
    vec4 compared = ycocg_of(whole_history ? history.color / history.weight : history.color);
    vec3 deviations = abs(compared - around.mean).xyz / around.deviation.xyz;
    float unlike = 4.0 * (deviations.x + deviations.y + deviations.z);
    // Of 2^-126 on the original's weights are 0; a thousandth is what it tests for.
    float limit = test_likeness ? log2(1e3) : 126.0;
    return unlike > limit ? refused : unlike;
}

vec4 blended(vec4 now, float variance, History surface, History mirror, Neighborhood around) {
    float unlike_surface = unlikeness(surface, around), unlike_mirror = unlikeness(mirror, around);
    float least = min(unlike_surface, unlike_mirror);
    if (least == refused) return now;
    float of_surface = exp2(least - unlike_surface), of_mirror = exp2(least - unlike_mirror);
    vec4 sum = of_surface * surface.color + of_mirror * mirror.color;
    vec4 history = ycocg_of(sum / (of_surface * surface.weight + of_mirror * mirror.weight));
    vec4 reach = clamp_deviations * around.deviation;
    history = color_of_ycocg(clamp(history, around.mean - reach, around.mean + reach));
    float scatter = clamp(variance / full_history_variance, 0.0, 1.0);
    vec4 result = mix(now, history, history_weight * mix(calm_history, 1.0, scatter));
    return clamp(result, vec4(0.0), vec4(vec3(largest_radiance), 1.0));
}

float blended_variance(float now, History mirror) {
    const bool is_quadratic = variance_mean == 0u;
    if (mirror.weight == 0.0) return now;
    float before = mirror.variance / mirror.weight;
    if (!is_quadratic) return mix(now, before, variance_history_weight);
    before = clamp(before, 0.0, 100.0);
    return sqrt(mix(now * now, before * before, variance_history_weight));
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (!is_on_screen(pixel)) return;
    vec4 color = texelFetch(resolved, pixel, 0);
    float variance = texelFetch(resolved_variance, pixel, 0).r;
    bool is_first_frame = camera.frame.w == 0u;
    if (temporal_accumulation && !is_first_frame && is_reflection(color)) {
        vec3 position = view_position(pixel);
        History surface = history_at(surface_place(pixel, position));
        History mirror = history_at(mirror_place(pixel, position));
        color = blended(color, variance, surface, mirror, neighborhood_of(pixel, ycocg_of(color)));
        variance = blended_variance(variance, mirror);
    }
    imageStore(accumulated, pixel, color);
    imageStore(accumulated_variance, pixel, vec4(variance));
}
