// What a neighbour's ray counts for a pixel, by the ratio estimator of Stachowiak and Uludag 2015 ("Stochastic
// Screen-Space Reflections"): the lobe of the pixel over the density with which the neighbour drew the ray.
#ifndef DILIGENT_SSR_REUSE_GLSL
#define DILIGENT_SSR_REUSE_GLSL
#include "core/shaders/view.glsl"
#include "diligent_ssr/distribution.glsl"

uniform sampler2D depth, normal, roughness;

const float least_weight = 1e-6;

struct Receiver {
    vec3 vs_position, vs_view_ray;  // unit ray from the camera
    vec3 ws_to_camera, ws_normal;   // unit
    float mu_camera, alpha;
};

// A ray as its pixel stored it.
struct Ray {
    vec4 radiance;      // a confidence
    vec3 ws_direction;  // times length (m)
    float density;      // sr^-1
};

Receiver receiver_at(ivec2 pixel) {
    vec2 uv = (vec2(pixel) + 0.5 + camera.jitter.xy) * camera.extent.zw;
    float perceptual_roughness = texelFetch(roughness, pixel, 0).r;
    Receiver receiver;
    receiver.vs_position = view_from_screen(uv, texelFetch(depth, pixel, 0).r);
    receiver.vs_view_ray = view_direction(receiver.vs_position);
    receiver.ws_to_camera = -(mat3(camera.world_from_view) * receiver.vs_view_ray);
    receiver.ws_normal = texelFetch(normal, pixel, 0).xyz;
    receiver.mu_camera = clamp(dot(receiver.ws_normal, receiver.ws_to_camera), 0.0, 1.0);
    receiver.alpha = perceptual_roughness * perceptual_roughness;
    return receiver;
}

// Lobe times cosine, without Fresnel, in the unit direction.
float lobe(Receiver receiver, vec3 ws_direction) {
    float mu_light = clamp(dot(receiver.ws_normal, ws_direction), 0.0, 1.0);
    vec3 ws_half = normalize(receiver.ws_to_camera + ws_direction);
    float mu_half = clamp(dot(receiver.ws_normal, ws_half), 0.0, 1.0);
    return smith_visibility(receiver.mu_camera, mu_light, receiver.alpha) *
           floored_distribution(mu_half, receiver.alpha) * mu_light;
}

// Share by the distance from the centre of the disk, in [0, 1].
float kernel(float distance) {
    const uint double_gaussian = 1u;
    const float deviation = 0.9;  // of the disk's radius
    float gaussian = exp(-distance * distance / (2.0 * deviation * deviation));
    return spatial_kernel == double_gaussian ? exp(-0.66 * gaussian * gaussian) : gaussian;
}

// Every ray counts a little, so that pixels whose lobe none of them meets have a colour; with finite_weights 0 for those
// that are not numbers.
float reuse_weight(Receiver receiver, Ray ray, float distance) {
    float hit_distance = length(ray.ws_direction);
    if (hit_distance < 1e-6) return least_weight;
    float weight = kernel(distance) * lobe(receiver, ray.ws_direction / hit_distance) / max(ray.density, 1e-5);
    if (finite_weights && (isnan(weight) || isinf(weight))) return 0.0;
    return max(weight, least_weight);
}
#endif
