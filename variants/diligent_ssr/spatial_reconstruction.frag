// Second pass of DiligentFX's denoising, after the rays: each pixel reuses the rays of eight neighbours.
#include "common/half.glsl"
#include "common/luminance.glsl"
#include "diligent_ssr/neighbor_rays.glsl"
#include "diligent_ssr/reuse.glsl"
#include "diligent_ssr/unknown_variance.glsl"

layout(location = 0) out vec4 resolved_radiance;
layout(location = 1) out float resolved_variance;
layout(location = 2) out float hit_depth;

// Weighted mean and variance, one ray after the other (West 1979, "Updating Mean and Variance Estimates").
struct Reuse {
    vec4 radiance;
    float weight, mean_luminance, squares, hit_distance;
};

Ray ray_at(ivec2 texel) {
    vec4 direction = texelFetch(ray_direction, texel, 0);
    return Ray(texelFetch(ray_radiance, texel, 0), direction.xyz, direction.w);
}

void add(inout Reuse reuse, Ray ray, float weight) {
    if (weight == 0.0) return;
    reuse.radiance += weight * ray.radiance;
    reuse.weight += weight;
    float from_old_mean = luma_bt601(ray.radiance.rgb) - reuse.mean_luminance;
    reuse.mean_luminance += weight / reuse.weight * from_old_mean;
    reuse.squares += weight * from_old_mean * (luma_bt601(ray.radiance.rgb) - reuse.mean_luminance);
    if (weight > least_weight) reuse.hit_distance = max(reuse.hit_distance, length(ray.ws_direction));
}

// Where a point of the pixel's disk is seen: pixels from the pixel. `place`: of the disk, in pixels.
vec2 offset_of(vec2 place, Receiver receiver, vec2 screen_position) {
    const uint in_world = 1u;  // parameter `reconstruction_space`
    if (reconstruction_space != in_world) return place;
    // As wide as a pixel is where the plane faces the camera.
    float pixel_width = 2.0 * (camera.frame.z == 1u ? 1.0 : dot(ws_eye() - receiver.ws_position, ws_backward())) /
                        (camera.clip_from_view[0][0] * camera.extent.x);
    mat3 about_normal = basis_from_normal(receiver.ws_normal);
    vec3 ws_place = receiver.ws_position + pixel_width * (about_normal * vec3(place, 0.0));
    vec4 clip = camera.clip_from_world * vec4(ws_place, 1.0);
    if (!(clip.w > 0.0)) return place;  // behind the camera
    return (clip.xy / clip.w * 0.5 + 0.5) * camera.extent.xy - screen_position;
}

Reuse reuse_neighbors(ivec2 pixel, Receiver receiver) {
    float radius = disk_radius(texelFetch(roughness, pixel, 0).r);
    mat2 rotation = disk_rotation(pixel);
    vec2 screen_position = vec2(pixel) + 0.5 + camera.jitter.xy;
    Reuse reuse = Reuse(vec4(0.0), 0.0, 0.0, 0.0, 0.0);
    for (int i = 0; i < samples_of(radius); ++i) {
        Ray ray = ray_at(neighbor_ray(pixel, offset_of(rotation * disk[i].xy * radius, receiver, screen_position)));
        add(reuse, ray, reuse_weight(receiver, ray, disk[i].z));
    }
    if (own_ray) {
        Ray ray = ray_at(own_ray_of(pixel));
        add(reuse, ray, reuse_weight(receiver, ray, 0.0));
    }
    return reuse;
}

float device_depth(float camera_depth) {
    vec4 clip = camera.clip_from_view * vec4(0.0, 0.0, -camera_depth, 1.0);
    return clip.z / clip.w;
}

// Of the mirrored point: as far behind the surface as the hit is before it.
float mirrored_depth(Receiver receiver, float hit_distance) {
    vec3 ws_mirrored = receiver.ws_position - receiver.ws_to_camera * hit_distance;
    float camera_depth = axial_hit_depth ? dot(ws_eye() - ws_mirrored, ws_backward())
                                         : receiver.camera_distance + hit_distance;
    return linear_hit_depth ? camera_depth : as_half(device_depth(camera_depth));
}

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    Receiver receiver = receiver_at(pixel);
    if (!spatial_reconstruction) {
        Ray ray = ray_at(own_ray_of(pixel));
        resolved_radiance = float_histories ? ray.radiance : as_halves(ray.radiance);
        resolved_variance = unknown_variance;
        hit_depth = mirrored_depth(receiver, length(ray.ws_direction));
        return;
    }
    Reuse reuse = reuse_neighbors(pixel, receiver);
    float weight = max(reuse.weight, 1e-6);
    resolved_radiance = reuse.radiance / weight;
    resolved_variance = reuse.squares / weight;
    if (!float_histories) {
        resolved_radiance = as_halves(resolved_radiance);
        resolved_variance = as_half(resolved_variance);
    }
    hit_depth = mirrored_depth(receiver, reuse.hit_distance);
}
