// One ratio estimator over neighbours and frames. A ray's weight is the density of the pixel's own lobe over the ray's
// density; the result is the weighted sum of what rays see over the sum of weights. A mirror thus takes nothing from
// other pixels' rays, and a pixel without a ray in this frame keeps its history.
#include "common/screen_probe/lookup.glsl"
#include "denoisers/ratio_accumulation/history.glsl"
#include "denoisers/ratio_accumulation/rounding.glsl"
#include "denoisers/seen_rays.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
uniform writeonly image2D accumulated, moments, reflected_length;  // of state.glsl

struct Sums {
    vec4 shown;    // of weights: radiance times confidence, confidence
    float weight;
    vec2 lengths;  // of weights of hits: length, 1
};

const float broad_from = 0.2;  // perceptual, from which on lobes count as wide

// Of three traced pixels; those that do not count have no density.
const uint most_rays = 3u * 4u;
struct Rays {
    TracedRay ray[most_rays];
    vec4 seen[most_rays];  // as of seen_rays.glsl
};

// Of the traced pixel and of those on both sides, in turns across and along the screen; every other time farther ones,
// which wide lobes take.
Rays rays_around(ivec2 center) {
    uint turn = camera.frame.x & 3u;
    int reach = turn >= 2u ? 2 : 1;
    ivec2 offset = (turn & 1u) == 0u ? ivec2(reach, 0) : ivec2(0, reach), last = traced_extent() - 1;
    Rays rays;
    for (uint n = 0u; n < 3u * max_rays; ++n) {
        uint from = n / max_rays;
        ivec2 traced = from == 0u ? center : from == 1u ? center - offset : center + offset;
        bool exists = traced == clamp(traced, ivec2(0), last) && (from == 0u || reuse_neighbors);
        uint index = index_of_ray(clamp(traced, ivec2(0), last), n % max_rays);
        rays.ray[n] = load_ray(index);
        rays.seen[n] = seen_by_ray[index];
        if (!exists || rays.ray[n].target == ray_below_horizon) rays.ray[n].inverse_density = 0.0;
    }
    return rays;
}

Sums sums_of(Rays rays, Receiver receiver) {
    Sums sums = Sums(vec4(0.0), 0.0, vec2(0.0));
    for (uint n = 0u; n < 3u * max_rays; ++n) {
        TracedRay ray = rays.ray[n];
        vec3 i = ray.direction * receiver.view_from_local;
        bool counts = ray.inverse_density != 0.0 && i.z > 0.0;
        const float largest_ratio = 4.0;  // so that no ray decides alone
        float ratio = lobe_density(lobe_of_visible_normals, receiver.o, i, receiver.alpha) * ray.inverse_density;
        float weight = counts ? min(ratio, largest_ratio) + least_ratio : 0.0;
        sums.shown += weight * shown_color(rays.seen[n]);
        sums.weight += weight;
        if (is_hit(ray)) sums.lengths += weight * vec2(ray.ray_length, 1.0);
    }
    return sums;
}

State state_of(Sums sums) {
    if (sums.weight == 0.0) return no_state;
    vec4 shown = sums.shown / sums.weight;
    float ray_length = sums.lengths.y > 0.0 ? sums.lengths.x / sums.lengths.y : 0.0;
    float compressed = compressed_luminance(shown);
    return State(shown, vec4(sums.weight, compressed, compressed, 0.0), ray_length);
}

float luminance_of(float compressed) {
    const float largest = 0.999999;
    return min(compressed, largest) / (1.0 - min(compressed, largest));
}

// What is known, from one compressed luminance to another: dimmed, or with what this frame's rays saw added.
vec4 brightened(vec4 shown, float from, float to, vec4 now) {
    float before = luminance_of(from), after = luminance_of(to), of_now = luminance_bt709(known_color(now).rgb);
    if (after < before) return vec4(shown.rgb * (after / before), shown.a);
    return of_now > 0.0 ? vec4(shown.rgb + shown.a * (after - before) / of_now * known_color(now).rgb, shown.a) : shown;
}

State blended(ivec2 pixel, Receiver receiver, State now, State before) {
    float now_weight = now.moments.x, weight = before.moments.x / (1.0 + motion_of_hit(pixel) / moved_pixels);
    float share = now_weight / (now_weight + weight);
    vec4 shown = mix(before.shown, now.shown, share);

    float frames = mix(1.0, change_frames, min(receiver.roughness / broad_from, 1.0));  // a mirror's rays have no noise
    float of_few = max(share, min(now_weight, 1.0) / frames), of_many = max(share, now_weight / max_history);
    vec3 means = mix(before.moments.yzw, now.moments.yzw, vec3(of_few, share, 0.0));
    float recent = means.x, lasting = means.y, difference = now.moments.y - before.moments.y, variance = before.moments.w;
    const float first = 1e-4, outlier = 16.0;  // a change that happens once is no noise
    variance = mix(variance, min(difference * difference, outlier * variance + first), of_many);

    // What lasts lies no farther from the recent mean than noise lets that be from it; what is moved there is no longer
    // the mean of so many rays. Where little is known luminances are of other things.
    const float least = 0.01, wholly = 0.99;  // of rounding, and of noise that is not known yet
    float reach = change_deviations * sqrt(variance / (2.0 * frames - 1.0)) + least;
    float allowed = clamp(lasting, max(recent - reach, 0.0), recent + reach);
    bool is_followed = change_deviations > 0.0 && before.shown.a >= wholly && now.shown.a >= wholly;
    if (is_followed && allowed != lasting) {
        shown = brightened(shown, lasting, allowed, now.shown);
        weight *= 1.0 - (allowed - lasting) / (recent - lasting);
        lasting = allowed;
    }
    const float of_length = 0.25;  // at least, since lengths are compared with this frame's
    float ray_length = mix(before.ray_length, now.ray_length, max(share, of_length * min(now_weight, 1.0)));
    return State(shown, vec4(min(weight + now_weight, max_history), recent, lasting, variance), ray_length);
}

State traced(ivec2 pixel, Receiver receiver, Rays rays) {
    State now = state_of(sums_of(rays, receiver));
    bool has_history = temporal_accumulation && camera.frame.w != 0u;
    if (!has_history) return now;
    State before = history_of(pixel, receiver, now.ray_length);
    return before.moments.x > 0.0 ? blended(pixel, receiver, now, before) : now;
}

// Without a ray: what the probe says about the middle of the lobe, which leans towards the normal (Lagarde and de
// Rousiers 2014, "Moving Frostbite to Physically Based Rendering", section 4.9.3).
State guessed(Receiver receiver) {
    vec3 mirrored = vec3(-receiver.o.xy, receiver.o.z);
    float smoothness = 1.0 - receiver.alpha;
    vec3 axis = normalize(mix(vec3(0.0, 0.0, 1.0), mirrored, smoothness * (sqrt(smoothness) + receiver.alpha)));
    mat3 world_from_view = mat3(camera.world_from_view);
    vec4 surfaces = surfaces_along(world_from_view * receiver.position, world_from_view * (receiver.view_from_local * axis));
    return State(surfaces, vec4(0.0), 0.0);
}

bool is_finite(vec4 color) { return !any(isnan(color)) && !any(isinf(color)); }

void accumulate(ivec2 pixel, Rays rays) {
    State state = no_state;
    float device_depth = texelFetch(depth, pixel, 0).r;
    if (!is_background(device_depth) && has_specular(pixel)) {
        Receiver receiver = receiver_at(pixel, device_depth, texelFetch(normal, pixel, 0));
        bool is_traced = receiver.roughness <= max_roughness;
        if (receiver.o.z > 0.0 && is_traced) state = traced(pixel, receiver, rays);
        if (receiver.o.z > 0.0 && !is_traced && rough_from_probe) state = guessed(receiver);
        // Of sums that overflow; of the largest floats so does a quotient.
        bool is_number = is_finite(state.shown) && is_finite(known_color(state.shown)) && is_finite(state.moments);
        if (!is_number) state = no_state;
    }
    uint noise = rounding_noise(pixel);
    imageStore(accumulated, pixel, rounded(known_color(state.shown), noise));
    imageStore(reflected_length, pixel, rounded(vec4(state.ray_length), noise));
    imageStore(moments, pixel, rounded(state.moments, noise));
}

// Once for all pixels that have the same traced pixel, whose rays are loaded once.
void main() {
    ivec2 center = ivec2(gl_GlobalInvocationID.xy);
    if (any(greaterThanEqual(center, traced_extent()))) return;
    Rays rays = rays_around(center);
    const int side = half_resolution ? 2 : 1;
    for (int n = 0; n < side * side; ++n) {
        ivec2 pixel = side * center + ivec2(n % side, n / side);
        if (is_on_screen(pixel)) accumulate(pixel, rays);
    }
}
