// The mean of the rays of a pixel and of the four next to it, and the speed of what its own rays met.
#include "common/ggx_lobe.h"
#include "common/mirror_ray.glsl"
#include "common/motion.glsl"
#include "denoisers/aimed_ray.glsl"
#include "denoisers/seen_rays.glsl"

layout(local_size_x = 8, local_size_y = 8) in;
uniform writeonly image2D gathered;       // radiance times confidence, confidence
uniform writeonly image2D target_motion;  // xy uv, as `motion`; z distance from the camera's plane (m)

// What a pixel's lobe is made of, as neighbours' rays are weighed by it. View space.
struct Receiver {
    vec3 position, geometric_normal;
    mat3 view_from_local;
    vec3 o;  // towards the viewer, local
    float alpha;
};

Receiver receiver_at(ivec2 pixel) {
    Receiver receiver;
    receiver.position = view_position(pixel);
    receiver.geometric_normal = view_geometric_normal(pixel);
    receiver.view_from_local = basis_from_normal(view_normal(pixel));
    receiver.o = -view_direction(receiver.position) * receiver.view_from_local;
    receiver.alpha = ggx_alpha(texelFetch(normal, pixel, 0).w);
    return receiver;
}

// f cos / p, without Fresnel, of visible normals drawn at the surface that the ray started from.
float weight_of_origin(ivec2 origin_pixel, vec3 direction) {
    vec3 axis = local_frame ? view_normal(origin_pixel) : mat3(camera.view_from_world) * vec3(0.0, 0.0, 1.0);
    float mu_o = -dot(view_direction(view_position(origin_pixel)), axis), mu_i = dot(direction, axis);
    float alpha = ggx_alpha(texelFetch(normal, origin_pixel, 0).w);
    return local_frame ? ggx_reflection_weight(mu_o, mu_i, alpha)
                       : ggx_reflection_weight(abs(mu_o), abs(mu_i), alpha);
}

// The direction in which the pixel itself would look at what the ray met.
vec3 direction_to_hit(Receiver receiver, ivec2 origin_pixel, TracedRay ray) {
    if (!is_hit(ray)) return ray.direction;
    return aimed_at_hit(view_position(origin_pixel) - receiver.position, ray).direction;
}

struct Sums {
    vec4 seen;             // of weights: radiance, 1; of what counts
    float weight;          // of all
    float own_confidence;  // of the pixel's own rays: of weights times confidence
    float own_weight;
};

void add_ray(inout Sums sums, Receiver receiver, ivec2 origin_pixel, uint index, bool is_own) {
    TracedRay ray = load_ray(index);
    if (ray.inverse_density == 0.0 || ray.target == ray_below_horizon) return;
    vec4 seen = seen_by_ray[index];
    float weight;
    if (ratio_estimator) {
        vec3 direction = direction_to_hit(receiver, origin_pixel, ray), i = direction * receiver.view_from_local;
        // As in the path-traced reference, such a direction is known to bring no light, whatever a neighbour's ray met
        // along it. One into the neighbour's surface alone was never looked along.
        bool is_into_surface = dot(direction, receiver.geometric_normal) <= 0.0;
        if (ray.target == ray_into_surface && !is_into_surface) return;
        if (is_into_surface) seen = vec4(0.0, 0.0, 0.0, 1.0);
        weight = ggx_specular(receiver.o, i, receiver.alpha) * max(i.z, 0.0) * ray.inverse_density;
    } else {
        weight = weight_of_origin(origin_pixel, ray.direction);
    }
    float counts = average_confidence ? seen.a : float(seen.a > 0.0);
    sums.seen += weight * counts * vec4(seen.rgb, 1.0);
    sums.weight += weight;
    if (is_own) {
        sums.own_confidence += weight * seen.a;
        sums.own_weight += weight;
    }
}

vec4 mean_of(Sums sums) {
    if (sums.seen.a <= 0.0) return vec4(0.0);
    float confidence = average_confidence     ? sums.seen.a / sums.weight
                       : sums.own_weight > 0.0 ? sums.own_confidence / sums.own_weight
                                               : 0.0;
    return min(confidence, 1.0) * vec4(sums.seen.rgb / sums.seen.a, 1.0);
}

vec4 gather(ivec2 pixel) {
    const ivec2 arms[5] = ivec2[5](ivec2(0), ivec2(1, 0), ivec2(-1, 0), ivec2(0, 1), ivec2(0, -1));
    bool is_mirror = texelFetch(normal, pixel, 0).w == 0.0;
    int arm_count = reuse_neighbors && !is_mirror ? 5 : 1;
    Receiver receiver = receiver_at(pixel);
    Sums sums = Sums(vec4(0.0), 0.0, 0.0, 0.0);
    for (int arm = 0; arm < arm_count; ++arm) {
        ivec2 traced = traced_of_pixel(pixel) + arms[arm];
        if (any(lessThan(traced, ivec2(0))) || any(greaterThanEqual(traced, traced_extent()))) continue;
        ivec2 origin_pixel = traced_pixel(traced, camera.frame.x);
        for (uint k = 0u; k < max_rays; ++k) add_ray(sums, receiver, origin_pixel, index_of_ray(traced, k), arm == 0);
    }
    return mean_of(sums);
}

// Of that of the pixel's rays whose target moves fastest.
vec3 motion_of_target(ivec2 pixel) {
    const ivec2 first_pixel = ivec2(0);  // whose uv marks a miss in HDRP, and to which it rounds each target's
    vec3 fastest = vec3(0.0);
    float largest = -1.0;
    for (uint k = 0u; k < max_rays; ++k) {
        TracedRay ray = load_ray(index_of_ray(traced_of_pixel(pixel), k));
        if (!is_hit(ray) && misses_stand_still) continue;
        ivec2 target = is_hit(ray) ? pixel_of_target(ray.target) : first_pixel;
        vec2 moved = motion_at(target);
        if (dot(moved, moved) <= largest) continue;
        largest = dot(moved, moved);
        fastest = vec3(moved, -view_z(texelFetch(depth, depth_of_target ? target : first_pixel, 0).r));
    }
    return fastest;
}

void main() {
    ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
    if (!is_on_screen(pixel)) return;
    vec4 mean = vec4(0.0);
    vec3 moved = vec3(0.0);
    if (reflects(pixel, max_roughness)) {
        mean = gather(pixel);
        moved = motion_of_target(pixel);
    }
    imageStore(gathered, pixel, mean);
    imageStore(target_motion, pixel, vec4(moved, 0.0));
}
