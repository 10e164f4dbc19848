// Combines each pixel's neighbouring rays, weighed by its own lobe over the densities with which they were drawn.
#include "common/ggx_lobe.h"
#include "common/mirror_ray.glsl"
#include "denoisers/aimed_ray.glsl"
#include "denoisers/ratio_filter/averages.glsl"
#include "denoisers/ratio_filter/taps.glsl"
#include "denoisers/seen_rays.glsl"
#include "denoisers/solid_angle.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
uniform writeonly image2D resolved, resolved_variance, resolved_length;

// What a pixel is to the rays that it weighs. View space.
struct Receiver {
    vec3 position, geometric_normal;
    mat3 view_from_local;
    vec3 o;  // towards the viewer, local
    float roughness, alpha;
    mat2x3 steps;  // from pixel to pixel on its plane, to the right and down (m)
};

mat2x3 steps_on_plane(ivec2 pixel, vec3 position, vec3 vs_normal) {
    float device_depth = texelFetch(depth, pixel, 0).r;
    vec2 uv = screen_from_pixel(pixel) * camera.extent.zw;
    vec3 view = view_direction(position);
    mat2x3 steps;
    for (int axis = 0; axis < 2; ++axis) {
        vec2 next = uv;
        next[axis] += camera.extent[2 + axis];
        vec3 across = view_from_screen(next, device_depth) - position;
        const float least_cosine = 1e-3;  // planes seen edge-on have no end
        steps[axis] = across + view * dot(across, vs_normal) / max(-dot(view, vs_normal), least_cosine);
    }
    return steps;
}

Receiver receiver_at(ivec2 pixel) {
    Receiver receiver;
    receiver.position = view_position(pixel);
    receiver.geometric_normal = view_geometric_normal(pixel);
    receiver.view_from_local = basis_from_normal(view_normal(pixel));
    receiver.o = -view_direction(receiver.position) * receiver.view_from_local;
    receiver.roughness = texelFetch(normal, pixel, 0).w;
    receiver.alpha = ggx_alpha(receiver.roughness);
    receiver.steps = steps_on_plane(pixel, receiver.position, receiver.geometric_normal);
    return receiver;
}

// A neighbour's ray from the pixel.
struct OwnRay {
    vec3 direction;
    float inverse_density;
};

OwnRay as_own_ray(Receiver receiver, ivec2 pixel, ivec2 traced_from, TracedRay ray) {
    const bool is_on_plane = neighbor_ray == 0u, is_as_it_is = neighbor_ray == 1u;
    OwnRay own = OwnRay(ray.direction, ray.inverse_density);
    if (is_as_it_is || !is_hit(ray)) return own;
    // Rough lobes are so wide that what is near them does not count as near (EEVEE's numbers).
    float nearness = max(0.2, clamp((0.75 - receiver.roughness) / 0.45, 0.0, 1.0));
    vec3 offset = is_on_plane ? nearness * (receiver.steps * vec2(traced_from - pixel))
                              : view_position(traced_from) - receiver.position;
    AimedRay aimed = aimed_at_hit(offset, ray);
    if (aimed.ray_length == 0.0) return own;
    own.direction = aimed.direction;
    if (reuse_jacobian && !is_on_plane)
        own.inverse_density *= solid_angle_ratio(view_geometric_normal(pixel_of_target(ray.target)), ray.direction,
                                                 own.direction, ray.ray_length / aimed.ray_length);
    return own;
}

float numerator_of(Receiver receiver, vec3 i) {
    const bool is_brdf = numerator == 1u;
    return is_brdf ? ggx_specular(receiver.o, i, receiver.alpha) * max(i.z, 0.0)
                   : lobe_density(lobe_of_visible_normals, receiver.o, i, receiver.alpha);
}

struct Sums {
    Running known;     // colours by weight and confidence
    Running shown;     // the same times confidence, by weight alone: what scatters in the picture
    uint count;        // of values in `known`
    vec3 last;         // of these, as it came
    float shortest;    // m; 0: no ray hit anything
    vec2 lengths;      // of weights: length, 1
};

void add_ray(inout Sums sums, Receiver receiver, ivec2 pixel, ivec2 traced_from, TracedRay ray, vec4 seen) {
    if (ray.inverse_density == 0.0 || ray.target == ray_below_horizon) return;
    OwnRay own = as_own_ray(receiver, pixel, traced_from, ray);
    bool is_into_surface = dot(own.direction, receiver.geometric_normal) <= 0.0;
    // Into the neighbour's surface alone: nobody has looked along it.
    if (ray.target == ray_into_surface && !is_into_surface) return;
    vec3 i = own.direction * receiver.view_from_local;
    if (local_horizon && i.z <= 0.0) return;
    if (local_horizon && is_into_surface) seen = vec4(0.0, 0.0, 0.0, 1.0);

    const float largest_weight = 1e30;
    float weight = min(numerator_of(receiver, i) * min(own.inverse_density, largest_weight), largest_weight);
    vec4 shown = shown_color(seen.rgb, seen.a);
    add_value(sums.known, weight * seen.a, is_logarithmic ? logarithm_of(seen.rgb) : seen.rgb);
    add_value(sums.shown, weight, is_logarithmic ? logarithm_of(shown.rgb) : shown.rgb);
    if (seen.a > 0.0) {
        sums.count += 1u;
        sums.last = seen.rgb;
    }
    if (!is_hit(ray) || ray.confidence == 0.0) return;
    sums.shortest = sums.shortest == 0.0 ? ray.ray_length : min(sums.shortest, ray.ray_length);
    sums.lengths += weight * ray.confidence * vec2(ray.ray_length, 1.0);
}

Sums sums_of(ivec2 pixel, Receiver receiver) {
    bool is_alone = !spatial_reuse || (sharp_mirrors && receiver.roughness == 0.0);
    uint count = is_alone ? 1u : spatial_tap_count(receiver.roughness);
    ivec2 center = is_alone ? traced_of_pixel(pixel) : nearest_traced(pixel);
    vec2 random = random_pair(pixel, 0u, spatial_dimension);
    Sums sums = Sums(no_values, no_values, 0u, vec3(0.0), 0.0, vec2(0.0));
    for (uint tap = 0u; tap < count; ++tap) {
        ivec2 traced = center;
        if (!is_alone) traced += tap_offset(tap, count, random, receiver.roughness, receiver.view_from_local[2]);
        if (any(lessThan(traced, ivec2(0))) || any(greaterThanEqual(traced, traced_extent()))) continue;
        ivec2 traced_from = traced_pixel(traced, camera.frame.x);
        for (uint k = 0u; k < max_rays; ++k) {
            vec4 seen = seen_by_ray[index_of_ray(traced, k)];
            seen.rgb = min(seen.rgb, largest_radiance);
            add_ray(sums, receiver, pixel, traced_from, load_ray(index_of_ray(traced, k)), seen);
        }
    }
    return sums;
}

vec4 mean_of(Sums sums) {
    if (sums.known.weight == 0.0) return vec4(0.0);
    // What is not averaged stays as it is to the last bit.
    vec3 color = sums.count == 1u ? sums.last
                 : is_logarithmic ? color_of_logarithm(sums.known.mean)
                                  : sums.known.mean;
    return shown_color(max(color, 0.0), min(sums.known.weight / sums.shown.weight, 1.0));
}

float largest_of(vec3 v) { return max(max(v.x, v.y), v.z); }

float variance_of(Sums sums) {
    vec3 mean = sums.shown.mean, variance = sums.shown.variance;
    if (is_logarithmic) variance = mix(vec3(0.0), variance / max(mean, 1e-37), greaterThan(mean, vec3(0.0)));
    return min(largest_of(variance), largest_radiance);
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (!is_on_screen(pixel)) return;
    const bool takes_shortest = reflection_depth == 0u;
    vec4 color = no_reflection;
    float variance = 0.0, ray_length = 0.0;
    if (reflects(pixel, max_roughness)) {
        Receiver receiver = receiver_at(pixel);
        color = vec4(0.0);
        if (receiver.o.z > 0.0) {
            Sums sums = sums_of(pixel, receiver);
            color = mean_of(sums);
            variance = variance_of(sums);
            ray_length = takes_shortest ? sums.shortest : sums.lengths.x / max(sums.lengths.y, 1e-37);
        }
    }
    imageStore(resolved, pixel, color);
    imageStore(resolved_variance, pixel, vec4(variance));
    imageStore(resolved_length, pixel, vec4(ray_length));
}
