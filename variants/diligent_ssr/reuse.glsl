// The weight of a neighbour's ray for a pixel, by the ratio estimator of Stachowiak and Uludag 2015 ("Stochastic
// Screen-Space Reflections"): the lobe of the pixel over the density with which the neighbour drew the ray.
#ifndef DILIGENT_SSR_REUSE_GLSL
#define DILIGENT_SSR_REUSE_GLSL
#include "diligent_ssr/distribution.glsl"

uniform sampler2D depth, normal, roughness;

const float least_weight = 1e-6;

struct Receiver {
    vec3 ws_position, ws_to_camera, ws_normal;  // the latter two unit
    float camera_distance, mu_camera, alpha;
};

// A ray as its pixel stored it.
struct Ray {
    vec4 radiance;      // a confidence
    vec3 ws_direction;  // times length (m)
    float density;      // sr^-1
};

vec3 ws_eye() { return camera.world_from_view[3].xyz; }
vec3 ws_backward() { return camera.world_from_view[2].xyz; }

Receiver receiver_at(ivec2 pixel) {
    vec2 uv = (vec2(pixel) + 0.5 + camera.jitter.xy) * camera.extent.zw;
    // As the original, not by view space: this matrix rounds by 1e-5 of the distance, which shows on smooth surfaces.
    vec4 world = camera.world_from_clip * vec4(uv * 2.0 - 1.0, texelFetch(depth, pixel, 0).r, 1.0);
    float perceptual_roughness = texelFetch(roughness, pixel, 0).r;
    bool is_orthographic = camera.frame.z == 1u;

    Receiver receiver;
    receiver.ws_position = world.xyz / world.w;
    receiver.ws_to_camera = is_orthographic ? ws_backward() : normalize(ws_eye() - receiver.ws_position);
    receiver.ws_normal = texelFetch(normal, pixel, 0).xyz;
    receiver.camera_distance = distance(ws_eye(), receiver.ws_position);
    receiver.mu_camera = clamp(dot(receiver.ws_normal, receiver.ws_to_camera), 0.0, 1.0);
    receiver.alpha = perceptual_roughness * perceptual_roughness;
    return receiver;
}

// smith_visibility() with the original's floor under each root, without which perfect mirrors have no number at grazing.
float floored_visibility(float mu_camera, float mu_light, float alpha) {
    float a2 = alpha * alpha;
    float root_camera = sqrt(max(mu_camera * mu_camera * (1.0 - a2) + a2, 1e-7));
    float root_light = sqrt(max(mu_light * mu_light * (1.0 - a2) + a2, 1e-7));
    return 0.5 / (mu_light * root_camera + mu_camera * root_light);
}

// Lobe times cosine, without Fresnel, in the unit direction.
float lobe(Receiver receiver, vec3 ws_direction) {
    float mu_light = clamp(dot(receiver.ws_normal, ws_direction), 0.0, 1.0);
    vec3 ws_half = normalize(receiver.ws_to_camera + ws_direction);
    float mu_half = clamp(dot(receiver.ws_normal, ws_half), 0.0, 1.0);
    return floored_visibility(receiver.mu_camera, mu_light, receiver.alpha) *
           floored_distribution(mu_half, receiver.alpha) * mu_light;
}

// Share by the distance from the centre of the disk, in [0, 1].
float kernel(float radius) {
    const uint double_gaussian = 1u;
    const float deviation = 0.9;  // of the disk's radius
    float gaussian = exp(-radius * radius / (2.0 * deviation * deviation));
    return spatial_kernel == double_gaussian ? exp(-0.66 * gaussian * gaussian) : gaussian;
}

// Clamps turn NaN into a number, so that the weight alone does not show it.
bool is_finite_weight(float weight, vec3 ws_direction, float density) {
    float sum = weight + ws_direction.x + ws_direction.y + ws_direction.z;
    return !isnan(sum) && !isinf(sum) && !isnan(density);
}

// Every ray counts a little, so that pixels whose lobe none of them meets have a colour; 0 with finite_weights for what
// is not a number.
float reuse_weight(Receiver receiver, Ray ray, float radius) {
    float hit_distance = length(ray.ws_direction);
    if (short_ray_guard && hit_distance < 1e-6) return least_weight;
    // Both as their year rounds, which shows in the weights of smooth surfaces.
    vec3 ws_direction = short_ray_guard ? ray.ws_direction / hit_distance
                                        : ray.ws_direction * inversesqrt(dot(ray.ws_direction, ray.ws_direction));
    float weight = kernel(radius) * lobe(receiver, ws_direction) / max(ray.density, 1e-5);
    if (finite_weights && !is_finite_weight(weight, ws_direction, ray.density)) return 0.0;
    return max(weight, least_weight);
}
#endif
